//! The control channel: JSON lines on a Unix socket, by which people and scripts see and steer a twin that runs.
//!
//! [`messages`] are the lines themselves: requests, answers, and the records of a subscription.

pub mod messages;
