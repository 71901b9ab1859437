//! A recording that is written as it grows, so that it survives whatever ends the program.

use std::fs::{File, OpenOptions};
use std::io::{self, Read};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};

use super::effects::{Files, at_home};
use super::new_file::{self, Readers};
use crate::session::replay::{HEADER, Recorder, comment, heading, lines};

/// The file of a recording.
#[derive(Debug)]
pub struct RecordingFile {
    path: PathBuf,
    file: File,
    /// For each line of steps, the index of its first step and its offset in bytes.
    lines: Vec<(usize, u64)>,
    /// Length in bytes of the comments at the beginning.
    heading: u64,
}

impl RecordingFile {
    /// Begins the file with what is recorded already; see [`RecordingFile::admit`]. Fails with one line if the
    /// file may not be replaced or cannot be written.
    pub fn begin(
        path: &Path,
        replace: bool,
        started: &str,
        recorder: &mut Recorder,
    ) -> Result<RecordingFile, String> {
        RecordingFile::admit(path, replace, "--force replaces it")?;
        let path = &at_home(path);
        let told = |why: io::Error| format!("{}: {why}", path.display());
        let comment = comment(&heading(started));
        new_file::write(path, comment.as_bytes(), Readers::Owner, true).map_err(told)?;
        let file = OpenOptions::new().write(true).open(path).map_err(told)?;
        let heading = comment.len() as u64;
        let mut record = RecordingFile { path: path.to_owned(), file, lines: Vec::new(), heading };
        record.keep(recorder)?;
        Ok(record)
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
        Err(format!("{name} is there already and is not a recording; {how}"))
    }

    /// Writes the changes since the last call. Fails with one line if the file cannot be written.
    pub fn keep(&mut self, recorder: &mut Recorder) -> Result<(), String> {
        let (unchanged, count) = (recorder.unchanged(), recorder.steps().len());
        if unchanged == count && !self.lines.is_empty() {
            return Ok(());
        }
        // The line with the first change and all lines after it are written again.
        let whole = self.lines.partition_point(|(first, _)| *first < unchanged);
        let (first, mut at) = match whole.checked_sub(1) {
            Some(last) => self.lines[last],
            None => (0, self.heading),
        };
        self.lines.truncate(whole.saturating_sub(1));
        let mut text = String::new();
        let begin = at;
        for (step, line) in lines(recorder.steps().get(first..).unwrap_or_default()) {
            self.lines.push((first + step, at));
            at += line.len() as u64;
            text += &line;
        }
        let written = self.file.write_all_at(text.as_bytes(), begin);
        let written = written.and_then(|()| self.file.set_len(at));
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
        let mut record = RecordingFile::begin(&path, false, "hopfscope", &mut recorder).unwrap();
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
                let plain = |text: &str| text.replace('\n', " ");
                assert_eq!(plain(&found), plain(&recorder.text("hopfscope")));
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
        let refused = RecordingFile::admit(&path, false, "--force replaces it").unwrap_err();
        assert!(refused.ends_with("is not a recording; --force replaces it"), "{refused}");
        assert!(RecordingFile::admit(folder.path(), true, "no").is_err(), "a folder is no file");
    }
}
