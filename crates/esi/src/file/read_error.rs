//! Why a file is not an ESI file.

use core::fmt;

use super::place::Place;

/// Why nothing can be read from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// It is longer than any ESI file.
    TooLong {
        /// Its length.
        length_bytes: usize,
    },
    /// It declares a character set that is not supported.
    Encoding {
        /// The declared name.
        declared: String,
    },
    /// It is not well-formed XML.
    NotXml {
        /// The place at which reading ended.
        place: Place,
        /// The reason.
        reason: String,
    },
    /// It has more elements and attributes than its length permits.
    TooManyElements {
        /// Its length.
        length_bytes: usize,
    },
    /// It is XML of another kind.
    AnotherRoot {
        /// The place of the root element.
        place: Place,
        /// Its name.
        root: String,
        /// The name of the one that is read.
        expected: &'static str,
    },
}

impl ReadError {
    /// Longest file that is read: 64 MiB.
    pub const LENGTH_BYTES_MAX: usize = 64 << 20;

    /// The place in the file, if there is one.
    #[must_use]
    pub const fn place(&self) -> Option<Place> {
        match self {
            Self::NotXml { place, .. } | Self::AnotherRoot { place, .. } => Some(*place),
            Self::TooLong { .. } | Self::Encoding { .. } | Self::TooManyElements { .. } => None,
        }
    }

    /// The way out.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::TooLong { .. } | Self::TooManyElements { .. } => {
                "keep the devices that you need, in a file of their own"
            }
            Self::Encoding { .. } => "save the file as UTF-8",
            Self::NotXml { .. } => "correct the XML at this place, or get the file from its vendor again",
            Self::AnotherRoot { root, .. } => match root.as_str() {
                "EtherCATConfig" => {
                    "this is the configuration of a network (ENI), made from ESI files: use those"
                }
                "EtherCATInfo" => {
                    "these are descriptions of devices (ESI), and not the configuration of a network"
                }
                "EtherCATDict" => {
                    "this is a dictionary: use the ESI file whose element DictionaryFile names it"
                }
                "EtherCATDiag" => {
                    "these are diagnosis texts: use the ESI file whose element DiagFile names it"
                }
                _ => "use an ESI file: its root element is EtherCATInfo",
            },
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong { length_bytes } => {
                write!(formatter, "the file has {length_bytes} bytes, limit {}", Self::LENGTH_BYTES_MAX)
            }
            Self::Encoding { declared } => {
                write!(formatter, "the file declares the character set `{}`", user_file::shown(declared))?;
                write!(formatter, ", expected UTF-8, UTF-16 or ISO-8859-1")
            }
            Self::NotXml { reason, .. } => write!(formatter, "the file is not well-formed XML: {reason}"),
            Self::TooManyElements { length_bytes } => {
                write!(
                    formatter,
                    "the file has too many elements and attributes for its {length_bytes} bytes"
                )
            }
            Self::AnotherRoot { root, expected, .. } => {
                write!(formatter, "the root element is `{}`, expected `{expected}`", user_file::shown(root))
            }
        }
    }
}

impl core::error::Error for ReadError {}
