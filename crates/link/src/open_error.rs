//! Why a link cannot be opened, and the remedy.

use std::fmt;
use std::io;

use crate::LinkSpec;

/// Why a link cannot be opened.
#[derive(Debug)]
pub enum OpenError {
    /// There is no network interface of this name.
    NoSuchInterface {
        /// The name.
        name: String,
        /// The names of the existing interfaces.
        available: Vec<String>,
    },
    /// A loopback interface returns each answer as the next frame.
    Loopback {
        /// The name.
        name: String,
    },
    /// Frames of this interface have no Ethernet header, such as those of a TUN interface.
    NotEthernet {
        /// The name.
        name: String,
    },
    /// The kernel refuses because a capability is missing.
    NoPermission {
        /// The link.
        link: LinkSpec,
        /// The error of the kernel.
        source: io::Error,
    },
    /// The address or the interface is in use by another program.
    InUse {
        /// The link.
        link: LinkSpec,
    },
    /// The address belongs to no interface of this machine.
    AddressNotHere {
        /// The link.
        link: LinkSpec,
    },
    /// Anything else.
    Failed {
        /// The link.
        link: LinkSpec,
        /// The error of the kernel.
        source: io::Error,
    },
}

impl OpenError {
    /// Classifies the kernel's error for `link`.
    pub(crate) fn of(link: LinkSpec, source: io::Error) -> Self {
        match source.kind() {
            io::ErrorKind::PermissionDenied => Self::NoPermission { link, source },
            io::ErrorKind::AddrInUse | io::ErrorKind::ResourceBusy => Self::InUse { link },
            io::ErrorKind::AddrNotAvailable => Self::AddressNotHere { link },
            _ => Self::Failed { link, source },
        }
    }

    /// The remedy for the user.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::NoSuchInterface { available, .. } => format!("there are: {}", available.join(", ")),
            Self::Loopback { .. } => {
                "for a master on this machine: udp:127.0.0.1, tap:ect0, or raw:u0 after \
                 `sudo ip link add m0 type veth peer name u0`, with the master at m0"
                    .to_owned()
            }
            Self::NotEthernet { .. } => {
                "use an Ethernet interface, or tap:ect0 for a master on this machine: a TAP interface has Ethernet frames, \
                 a TUN interface has IP packets"
                    .to_owned()
            }
            Self::NoPermission { link, .. } => help_for_permission(link),
            Self::InUse { link: LinkSpec::Udp(_) } => {
                "end the program that uses it, or use another port: udp:ADDR:PORT".to_owned()
            }
            Self::InUse { link: LinkSpec::Raw(_) } => {
                "another ectwin answers on this interface, or is the other end of this TAP interface: end it, or use \
                 another interface"
                    .to_owned()
            }
            Self::InUse { .. } => "end the program that uses it, or use another name".to_owned(),
            Self::AddressNotHere { .. } => {
                "use an address of this machine: 127.0.0.1 for masters on it, 0.0.0.0 for every interface"
                    .to_owned()
            }
            Self::Failed { link: LinkSpec::Tap(_), source } if source.kind() == io::ErrorKind::NotFound => {
                "the kernel has no TAP driver here: load it by `sudo modprobe tun`".to_owned()
            }
            Self::Failed { link: LinkSpec::Raw(name), .. } => {
                format!("check the interface with `ip -details link show {name}`")
            }
            Self::Failed { .. } => "a link that always works: udp:127.0.0.1".to_owned(),
        }
    }
}

fn help_for_permission(link: &LinkSpec) -> String {
    let capability = match link {
        LinkSpec::Raw(_) => "cap_net_raw",
        LinkSpec::Tap(_) => "cap_net_admin",
        LinkSpec::Udp(_) => return "use a port of 1024 or above".to_owned(),
    };
    format!(
        "give the program the capability by `sudo setcap {capability}+ep \"$(command -v ectwin)\"` (it is needed at \
         start only, and dropped then), or try it in a network namespace of your own, `unshare -Urn`, or take udp:127.0.0.1"
    )
}

impl fmt::Display for OpenError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchInterface { name, .. } => {
                write!(formatter, "there is no network interface \"{name}\"")
            }
            Self::Loopback { name } => write!(
                formatter,
                "raw:{name} is refused: {name} is a loopback interface, which returns each answer as the next frame"
            ),
            Self::NotEthernet { name } => write!(
                formatter,
                "raw:{name} is refused: {name} has no Ethernet frames, and EtherCAT needs them"
            ),
            Self::NoPermission { link: link @ LinkSpec::Raw(_), .. } => {
                write!(formatter, "no permission to open {link}: raw frames need CAP_NET_RAW")
            }
            Self::NoPermission { link: link @ LinkSpec::Tap(_), .. } => {
                write!(formatter, "no permission to open {link}: a TAP interface needs CAP_NET_ADMIN")
            }
            Self::NoPermission { link, .. } => write!(formatter, "no permission to open {link}"),
            Self::InUse { link } => write!(formatter, "{link} is in use"),
            Self::AddressNotHere { link } => write!(formatter, "{link} is not an address of this machine"),
            Self::Failed { link, source } => write!(formatter, "cannot open {link}: {source}"),
        }
    }
}

impl std::error::Error for OpenError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::NoPermission { source, .. } => Some(source),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_permission_the_message_names_the_capability_and_the_way_out() {
        for (link, capability) in [("raw:eth0", "CAP_NET_RAW"), ("tap:ect0", "CAP_NET_ADMIN")] {
            let error = OpenError::of(link.parse().unwrap(), io::ErrorKind::PermissionDenied.into());
            assert!(error.to_string().contains(capability), "{error}");
            assert!(error.help().contains("setcap") && error.help().contains("unshare -Urn"));
        }
    }
}
