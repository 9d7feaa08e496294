//! What a master can do to a unit of this line, and what can be seen of it.

use mailbox::SdoValue;
use wire::AlState;

use super::maker::Maker;
use super::model_words::Needed;
use super::problem::Part;
use crate::model::{MasterAct, UnitSet, WhichUnit};

impl Maker<'_> {
    /// Whether an act can come.
    pub(super) fn check_act(&mut self, act: &MasterAct, part: Part) -> Option<()> {
        match act {
            MasterAct::ReadSdo { unit, .. } | MasterAct::MiscountMailbox { unit } => {
                self.check_mailbox(unit, part)
            }
            MasterAct::WriteSdo { unit, value, .. } => {
                self.check_mailbox(unit, part)?;
                let length_bytes = value.as_ref().map_or(0, |value| value.0.len());
                self.check_seen(length_bytes, part)
            }
            MasterAct::ReadRegister { unit, register } => self.check_register(unit, register.0, 1, part),
            MasterAct::WriteRegister { unit, register, bytes } => {
                let length_bytes = bytes.as_ref().map_or(1, |bytes| bytes.0.len());
                self.check_register(unit, register.0, length_bytes, part)
            }
            MasterAct::RequestState { unit, state: AlState::Boot } => self.check_boot(unit, part),
            MasterAct::SendOutputs { unit } => self.check_has_outputs(unit, part),
            MasterAct::ReadSiiWord { .. }
            | MasterAct::RequestState { .. }
            | MasterAct::AcknowledgeError { .. } => Some(()),
        }
    }

    /// A percentage of deviation.
    pub(super) fn check_deviation(&mut self, percent: u8, part: Part) -> Option<()> {
        if (1..=100).contains(&percent) {
            return Some(());
        }
        let message = format!("a deviation of {percent} %");
        self.refuse(part, message, "1 to 100 %, such as `± 20 %`");
        None
    }

    fn check_seen(&mut self, length_bytes: usize, part: Part) -> Option<()> {
        let most = SdoValue::HEAD_BYTES;
        if length_bytes <= most {
            return Some(());
        }
        let message = format!("{length_bytes} bytes of an SDO, of which only the first {most} are seen");
        self.refuse(part, message, "leave the value out, or check it by `object … of unit … begins with …`");
        None
    }

    fn check_boot(&mut self, unit: &WhichUnit, part: Part) -> Option<()> {
        let is_known = Box::new(|unit: &dyn unit_model::UnitSection| unit.shape().boot);
        let (units, words) = (UnitSet::from(unit.clone()), "state BOOT".to_owned());
        self.check_words(&Needed { units, words, is_known }, part)
    }

    fn check_has_outputs(&mut self, unit: &WhichUnit, part: Part) -> Option<()> {
        let is_known = Box::new(|unit: &dyn unit_model::UnitSection| unit.process_data_bytes().outputs > 0);
        let (units, words) = (UnitSet::from(unit.clone()), "outputs".to_owned());
        self.check_words(&Needed { units, words, is_known }, part)
    }
}
