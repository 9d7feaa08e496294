//! Emergencies that conditions name.

use super::maker::Maker;
use super::problem::Part;
use crate::model::{Bytes, Condition};

/// Number of bytes after the error register (ETG.1000.6).
const DATA_BYTES: usize = 5;

impl Maker<'_> {
    /// Whether an emergency can have the data of a condition.
    pub(super) fn check_emergency(&mut self, condition: &Condition, part: Part) -> Option<()> {
        let Condition::Emergency { data: Some(Bytes(data)), .. } = condition else { return Some(()) };
        if data.len() == DATA_BYTES {
            return Some(());
        }
        let message = format!("{} bytes of data, and an emergency has {DATA_BYTES}", data.len());
        self.refuse(part, message, "those after the error register, such as 00 00 00 20 80");
        None
    }
}
