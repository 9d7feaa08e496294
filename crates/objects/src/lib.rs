//! The object dictionary: objects, entries, types, access rights, values.
//!
//! An [`ObjectTable`] describes (and is shared by all units of a model); an [`ObjectServer`] holds the
//! values of one unit and answers for them. Who speaks CoE asks the table what exists and who may touch it,
//! and the server only for values.

mod description;
mod server;

pub use description::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
pub use server::{ObjectServer, SdoAbort};
