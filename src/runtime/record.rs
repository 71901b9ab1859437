//! A recording that is written as it grows, so that it survives whatever ends the program.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::effects::at_home;
use super::{Files, Readers, new_file};
use crate::session::replay::{HEADER, Recorder};

/// The file of a recording.
pub struct RecordingFile {
    path: PathBuf,
    file: File,
    /// What the file holds.
    text: String,
}

impl RecordingFile {
    /// Begins the file with what is recorded already; see [`RecordingFile::admit`]. Fails with one line if the
    /// file may not be replaced or cannot be written.
    pub fn begin(
        path: &Path,
        replace: bool,
        recorder: &mut Recorder,
    ) -> Result<RecordingFile, String> {
        RecordingFile::admit(path, replace, "add --force to overwrite")?;
        let path = &at_home(path);
        recorder.take_changed();
        let text = recorder.text();
        new_file::write(path, text.as_bytes(), Readers::Owner, None)
            .map_err(|why| why.to_string())?;
        let file = OpenOptions::new().write(true).open(path);
        let file = file.map_err(|why| format!("{}: {why}", path.display()))?;
        Ok(RecordingFile { path: path.to_owned(), file, text })
    }

    /// Whether a recording may be written to a file: it does not exist, is empty, or is a recording itself.
    /// Fails with one line; `how` tells how to replace the file all the same.
    pub fn admit(path: &Path, replace: bool, how: &str) -> Result<(), String> {
        Files::admit(path, true)?;
        let path = at_home(path);
        let name = path.display();
        let begin = match File::open(&path) {
            _ if replace => return Ok(()),
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(()),
            begin => begin.map_err(|why| format!("{name}: {why}"))?,
        };
        let mut head = String::new();
        // A file that is not text is not a recording.
        let read = begin.take(HEADER.len() as u64).read_to_string(&mut head);
        if read.is_ok() && (head.is_empty() || head == HEADER) {
            return Ok(());
        }
        Err(format!("{name} already exists and is not a recording; {how}"))
    }

    /// Writes the changes since the last call. Fails with one line if the file cannot be written.
    pub fn keep(&mut self, recorder: &mut Recorder) -> Result<(), String> {
        if !recorder.take_changed() {
            return Ok(());
        }
        let text = recorder.text();
        let same = text.bytes().zip(self.text.bytes()).take_while(|(new, old)| new == old).count();
        let written = new_file::write_at(&self.file, &text.as_bytes()[same..], same as u64);
        let written = written.and_then(|()| self.file.set_len(text.len() as u64));
        self.text = text;
        written.map_err(|why| format!("no longer recorded: {}: {why}", self.path.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::Msg;

    fn note(recorder: &mut Recorder, key: &str) {
        recorder.note(&Msg::Key(key.parse().unwrap()));
    }

    #[test]
    fn the_file_holds_at_every_moment_what_was_recorded_so_far() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.keys");
        let mut recorder = Recorder::default();
        let mut record = RecordingFile::begin(&path, false, &mut recorder).unwrap();
        for round in 0..200_u32 {
            note(&mut recorder, ["<right>", "u", "<S-left>"][round as usize / 2 % 3]);
            if round % 17 == 0 {
                recorder.forget(round % 7);
            }
            if round % 40 == 3 {
                recorder.embed("b.keys", &round.to_string(), 5);
            }
            if round % 3 > 0 {
                record.keep(&mut recorder).unwrap();
                let found = std::fs::read_to_string(&path).unwrap();
                assert_eq!(found, recorder.text());
            }
        }
    }

    #[test]
    fn only_a_recording_or_nothing_is_replaced_unasked() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scan.csv");
        for (text, may) in [
            ("D,r\n", false),
            ("# hopfscope\n<right>\n", false),
            ("# A rec", false),
            ("\u{fffd}", false),
            ("", true),
            ("# A recording of hopfscope; `hopfscope replay FILE` plays it.\n", true),
        ] {
            std::fs::write(&path, text).unwrap();
            assert_eq!(RecordingFile::admit(&path, false, "no").is_ok(), may, "{text:?}");
            assert!(RecordingFile::admit(&path, true, "no").is_ok(), "{text:?}");
        }
        std::fs::write(&path, [0xff; 64]).unwrap();
        let refused = RecordingFile::admit(&path, false, "add --force to overwrite").unwrap_err();
        assert!(refused.ends_with("is not a recording; add --force to overwrite"), "{refused}");
        assert!(RecordingFile::admit(folder.path(), true, "no").is_err(), "a folder is no file");
    }
}
