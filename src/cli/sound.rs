//! `hopfscope sound`: a motion, to be heard.

use std::path::PathBuf;

use clap::Args;

use super::input::{self, MACHINE, OSCILLATOR};
use super::{Failure, Result, SourceOptions, given, print, troubled, write};
use crate::flow::{Limits, Subject};
use crate::runtime::wav;
use crate::scan::Sound;
use crate::scan::sound::HEARD;
use crate::session::{Session, Size};
use crate::words::significant;

/// Writes a motion as a sound: its velocity, with every stick and slip, in 48 kHz, 16 bit, mono
#[derive(Args)]
pub struct SoundCommand {
    #[command(flatten)]
    source: SourceOptions,
    /// File to write
    #[arg(long, value_name = "FILE.wav", value_parser = |text: &str| input::file(text, "a sound", "wav"))]
    output: PathBuf,
    /// Replaces what FILE holds
    #[arg(long)]
    force: bool,
    /// Length in s, 0.1 .. 600 (default: 4)
    #[arg(long, value_name = "S", value_parser = |text: &str| input::within(text, "s", 0.1..=600.0))]
    seconds: Option<f64>,
    /// Frequency at which the natural frequency is heard, 1 .. 20000 Hz (default: a machine's own from 20 Hz, or 220)
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = |text: &str| input::within(text, "Hz", 1.0..=*HEARD.end()))]
    pitch: Option<f64>,
    /// A parameter, or a number of the machine, that glides from the beginning to the end while the motion goes on
    #[arg(long, value_name = "NAME=FROM:TO")]
    over: Option<String>,
}

impl SoundCommand {
    pub fn run(&self) -> Result<()> {
        let mut sound = Sound::usual(self.subject()?).map_err(troubled)?;
        sound.seconds = self.seconds.unwrap_or(sound.seconds);
        sound.pitch = self.pitch.unwrap_or(sound.pitch);
        let pieces = Sound::pieces(sound.seconds);
        let is_machine = sound.subject.paper().is_none();
        let numbers = if is_machine { &MACHINE } else { &OSCILLATOR };
        sound.glide = given("--over", self.over.as_ref(), |text| numbers.glide(text, pieces))?;
        let wav = wav::wav(&sound, &Limits::PATIENT).map_err(Failure::Unanswered)?;
        write(&self.output, &wav.content, self.force)?;
        let (path, Sound { seconds, pitch, .. }) = (self.output.display(), sound);
        let (pitch, [from, to]) = (significant(pitch, 5), wav.heard.map(|it| significant(it, 4)));
        let heard = format!("louder than a hundredth of its peak from {from} to {to} s");
        print(&format!("{path}: {seconds} s, the natural frequency at {pitch} Hz, {heard}\n"))
    }

    /// The machine, or what a scene draws: by the whole model if it is that of a machine.
    fn subject(&self) -> Result<Subject> {
        if self.source.machine_name().is_some() {
            return Ok(self.source.exact()?.described.subject);
        }
        Ok(Session::new(self.source.scene()?, Size::default()).subject())
    }
}
