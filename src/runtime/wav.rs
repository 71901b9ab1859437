//! Sound as a file: 48 kHz, 16 bit, mono.

use std::io::Cursor;

use hound::{SampleFormat, WavSpec, WavWriter};

use crate::flow::{Limits, Reason};
use crate::numerics::real;
use crate::scan::Sound;
use crate::scan::sound::RATE;
use crate::words::significant;

/// What the largest velocity becomes: nine tenths of the largest sample, so that no player clips it.
const LOUDEST: f64 = 0.9 * 32_767.0;

const SPEC: WavSpec = WavSpec {
    channels: 1,
    sample_rate: RATE,
    bits_per_sample: 16,
    sample_format: SampleFormat::Int,
};

/// A sound as a file.
pub struct Wav {
    pub content: Vec<u8>,
    /// From when until when, in s, it is louder than a hundredth of its peak: a motion may end early, or grow.
    pub heard: [f64; 2],
}

/// A sound as a file. Fails with one line if the motion ends before the sound, or is none.
pub fn wav(sound: &Sound, limits: &Limits) -> Result<Wav, String> {
    let ended = |(seconds, why): (f64, Reason)| {
        format!("no sound: {why}, within {} s", significant(seconds, 3))
    };
    let velocities = sound.velocities(limits).map_err(ended)?;
    let peak = velocities.iter().fold(0.0_f64, |peak, velocity| peak.max(velocity.abs()));
    if peak == 0.0 {
        return Err("no sound: the mass is at rest and stays there".to_owned());
    }
    let mut bytes = Cursor::new(Vec::new());
    let written = WavWriter::new(&mut bytes, SPEC).and_then(|mut writer| {
        let mut samples = velocities.iter().map(|velocity| (velocity / peak * LOUDEST).round());
        #[expect(clippy::cast_possible_truncation, reason = "at most LOUDEST")]
        samples.try_for_each(|sample| writer.write_sample(sample as i16))?;
        writer.finalize()
    });
    written.map_err(|why| format!("no sound: {why}"))?;
    let loud = |velocity: &f64| velocity.abs() > 0.01 * peak;
    let ends = [velocities.iter().position(loud), velocities.iter().rposition(loud)];
    let heard = ends.map(|at| real(at.unwrap_or(0)) / f64::from(RATE));
    Ok(Wav { content: bytes.into_inner(), heard })
}
