//! A slave as an ESI file describes it, without a processor of its own: its controller, its SII and its process data.
//!
//! [`device_config`] describes a device of a file to the slave stack, and an [`IoImage`] holds its process data. A
//! device that needs more than that is refused with [`NotYet`]; nothing of a file is left out without a word.
//!
//! Requests of the master are checked, also where the controller of the device follows every request (device emulation).

mod config;
mod io_image;
mod not_yet;
mod process_data;

pub use config::device_config;
pub use io_image::IoImage;
pub use not_yet::NotYet;
