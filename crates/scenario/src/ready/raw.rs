//! Frames, mailbox messages and registers that an order names byte by byte.

use super::maker::Maker;
use super::problem::Part;
use crate::model::MasterOrder;

/// The bytes of an Ethernet header.
const FRAME_BYTES_MIN: usize = 14;
/// The longest frame, without frame check sequence and without tag.
const FRAME_BYTES_MAX: usize = 1514;
/// The address space of the ESC.
const ESC_BYTES: u32 = 0x1_0000;

impl Maker<'_> {
    /// Whether the bytes of an order can be sent, and those that it reads exist.
    pub(super) fn check_raw(&mut self, order: &MasterOrder, part: Part) -> Option<()> {
        let (message, help) = if let MasterOrder::SendFrame { frame } = order {
            let length = frame.0.len();
            if (FRAME_BYTES_MIN..=FRAME_BYTES_MAX).contains(&length) {
                return Some(());
            }
            let help = "a frame has 14 to 1514 bytes: it begins with two addresses and the EtherType 88 A4";
            (format!("a frame of {length} bytes"), help.to_owned())
        } else if let MasterOrder::SendMailboxMessage { unit, message } = order {
            let device = self.units.get(unit.position())?.known_device();
            let Some(mailbox) = &device.description.mailbox else {
                self.refuse(part, format!("{unit} has no mailbox"), "name a unit with one");
                return None;
            };
            let (length, room) = (message.0.len(), usize::from(mailbox.receive.length_bytes));
            if length <= room {
                return Some(());
            }
            (
                format!("{length} bytes for a mailbox of {room}"),
                "a message begins with its header of six bytes".to_owned(),
            )
        } else if let MasterOrder::ReadRegister { register, length_bytes: Some(length), .. } = order {
            if u32::from(register.0) + u32::from(*length) <= ESC_BYTES {
                return Some(());
            }
            (format!("{length} bytes from register {register} on"), "the ESC ends at 0xFFFF".to_owned())
        } else {
            return Some(());
        };
        self.refuse(part, message, help);
        None
    }
}
