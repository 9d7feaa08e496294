//! The object dictionary: objects, entries, types, access rights, values.
//!
//! An [`ObjectTable`] describes the objects (and is shared by all units of a model); an [`ObjectServer`] holds
//! the values of one unit and answers for them. A CoE implementation looks up existence and access rights in
//! the table, and asks the server only for values.

pub mod complete;
mod description;
mod dictionary;
mod layout;
mod server;
mod table;

pub use description::{AccessRights, Entry, Object, ObjectCode};
pub use dictionary::Dictionary;
pub use layout::{Layout, Slot};
pub use server::ObjectServer;
pub use table::ObjectTable;
pub use wire::SdoAbort;
