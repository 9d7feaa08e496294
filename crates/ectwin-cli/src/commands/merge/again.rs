//! Results that are read again, one by one, by their places.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::PathBuf;

use super::place::Place;
use crate::commands::replay::CaseResult;
use crate::failure::Failure;

/// Most files that are open at once.
const OPEN_FILES_MAX: usize = 64;

/// The files of results, which have been read and found right.
pub(super) struct ResultsAgain<'a> {
    paths: &'a [PathBuf],
    open: BTreeMap<u32, Reader>,
    line: Vec<u8>,
}

/// An open file.
struct Reader {
    file: BufReader<File>,
    /// Where it is, in bytes.
    at: u64,
}

impl<'a> ResultsAgain<'a> {
    pub(super) const fn new(paths: &'a [PathBuf]) -> Self {
        Self { paths, open: BTreeMap::new(), line: Vec::new() }
    }

    /// The result at this place.
    pub(super) fn read(&mut self, place: &Place) -> Result<CaseResult, Failure> {
        let result = self.line(place).and_then(|()| Ok(serde_json::from_slice(&self.line)?));
        result.map_err(|error: io::Error| {
            let path = self.path(place);
            let help = "leave the files of results as they are until the command ends".to_owned();
            Failure::Refused { message: format!("cannot read {} again: {error}", path.display()), help }
        })
    }

    fn line(&mut self, place: &Place) -> io::Result<()> {
        if !self.open.contains_key(&place.file) {
            if self.open.len() == OPEN_FILES_MAX {
                self.open.clear();
            }
            let file = BufReader::new(File::open(self.path(place))?);
            self.open.insert(place.file, Reader { file, at: 0 });
        }
        self.line.clear();
        let Some(reader) = self.open.get_mut(&place.file) else { return Ok(()) };
        // Parts have their cases in order: most of the lines are in the buffer.
        reader.file.seek_relative(place.start.wrapping_sub(reader.at).cast_signed())?;
        reader.at = place.start + reader.file.read_until(b'\n', &mut self.line)? as u64;
        Ok(())
    }

    fn path(&self, place: &Place) -> PathBuf {
        self.paths.get(place.file as usize - 1).cloned().unwrap_or_default()
    }
}
