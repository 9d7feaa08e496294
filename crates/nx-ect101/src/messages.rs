//! The messages between master and CPU Unit: one buffer of 200 bytes in each direction, with its handshake
//! (manual, A-5).
//!
//! A write fills the buffer, a read empties it. While it is full a further write is refused and the buffer
//! keeps its contents, so nothing is lost; a read of an empty buffer returns the previous contents.

use wire::SdoAbort;

/// Length of a message in bytes.
pub const MESSAGE_BYTES: usize = 200;

/// One message.
pub(crate) type Message = [u8; MESSAGE_BYTES];

/// The buffer holds a message that has not been read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotReady;

impl From<NotReady> for SdoAbort {
    /// The manual does not define a code for a write while not ready.
    fn from(_: NotReady) -> Self {
        Self::LOCAL_CONTROL
    }
}

/// Both directions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Messages {
    /// CoE 3001 to NX 5000.
    pub(crate) m_to_c: MessageBuffer,
    /// NX 5001 to CoE 3000.
    pub(crate) c_to_m: MessageBuffer,
}

/// One direction.
#[derive(Clone, Debug)]
pub(crate) struct MessageBuffer {
    message: Message,
    is_new: bool,
}

impl MessageBuffer {
    /// Whether it holds a message that has not been read.
    pub(crate) const fn has_new(&self) -> bool {
        self.is_new
    }

    /// Whether a message may be written.
    pub(crate) const fn is_ready(&self) -> bool {
        !self.is_new
    }

    /// Stores a message, if the last one has been read.
    pub(crate) const fn write(&mut self, message: &Message) -> Result<(), NotReady> {
        if self.is_new {
            return Err(NotReady);
        }
        self.message = *message;
        self.is_new = true;
        Ok(())
    }

    /// Returns the message and marks it as read.
    pub(crate) const fn read(&mut self) -> &Message {
        self.is_new = false;
        &self.message
    }

    /// The message for its writer, without marking it as read.
    pub(crate) const fn written(&self) -> &Message {
        &self.message
    }
}

impl Default for MessageBuffer {
    /// 200 zeros that have not been written.
    fn default() -> Self {
        Self { message: [0; MESSAGE_BYTES], is_new: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_buffer_refuses_and_keeps_what_it_holds() {
        let mut buffer = MessageBuffer::default();
        assert!(buffer.is_ready() && !buffer.has_new());
        assert_eq!(buffer.write(&[1; 200]), Ok(()));
        assert_eq!(buffer.write(&[2; 200]), Err(NotReady));
        assert!(buffer.has_new() && !buffer.is_ready());
        assert_eq!(buffer.written(), &[1; 200]);
        assert_eq!(buffer.read(), &[1; 200]);
        assert!(buffer.is_ready());
        assert_eq!(buffer.read(), &[1; 200], "once more, as nothing new has come");
        assert_eq!(buffer.write(&[2; 200]), Ok(()));
    }
}
