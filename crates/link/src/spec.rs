//! The notation for links.

use std::fmt;
use std::net::{IpAddr, SocketAddr};
use std::str::FromStr;

/// The UDP port of EtherCAT.
pub const DEFAULT_UDP_PORT: u16 = 34980;

/// Longest name of a network interface in bytes (Linux, `IFNAMSIZ` without the terminator).
const INTERFACE_NAME_BYTES_MAX: usize = 15;

/// A link by its name, as on the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkSpec {
    /// `raw:IFNAME`: a network interface.
    Raw(String),
    /// `udp:ADDR:PORT`: EtherCAT in UDP at this local address.
    Udp(SocketAddr),
    /// `tap:NAME`: a TAP interface, created if it does not exist.
    Tap(String),
}

impl fmt::Display for LinkSpec {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Raw(name) => write!(formatter, "raw:{name}"),
            Self::Udp(address) => write!(formatter, "udp:{address}"),
            Self::Tap(name) => write!(formatter, "tap:{name}"),
        }
    }
}

/// A text that is not a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotALink {
    /// There is no `raw:`, `udp:` or `tap:` at the start.
    UnknownKind(String),
    /// The text after `raw:` or `tap:` cannot be the name of an interface.
    NotAnInterfaceName(String),
    /// The text after `udp:` is not an address.
    NotAnAddress(String),
}

impl fmt::Display for NotALink {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownKind(text) => write!(
                formatter,
                "\"{text}\" names no link: expected raw:IFNAME, udp:ADDR[:PORT] or tap:NAME, \
                 such as raw:eth0, udp:127.0.0.1 or tap:ect0"
            ),
            Self::NotAnInterfaceName(name) => write!(
                formatter,
                "\"{name}\" cannot be the name of a network interface: \
                 expected 1 to {INTERFACE_NAME_BYTES_MAX} characters without blanks, '/' and ':'"
            ),
            Self::NotAnAddress(text) => write!(
                formatter,
                "\"{text}\" is no address: expected an IP address with or without a port, \
                 such as 127.0.0.1:{DEFAULT_UDP_PORT} or [::1]:{DEFAULT_UDP_PORT}"
            ),
        }
    }
}

impl std::error::Error for NotALink {}

impl FromStr for LinkSpec {
    type Err = NotALink;

    fn from_str(text: &str) -> Result<Self, NotALink> {
        match text.split_once(':') {
            Some(("raw", name)) => interface_name(name).map(Self::Raw),
            Some(("tap", name)) => interface_name(name).map(Self::Tap),
            Some(("udp", address)) => socket_address(address).map(Self::Udp),
            _ => Err(NotALink::UnknownKind(text.to_owned())),
        }
    }
}

fn interface_name(name: &str) -> Result<String, NotALink> {
    let fits = (1..=INTERFACE_NAME_BYTES_MAX).contains(&name.len()) && name != "." && name != "..";
    let legal = |c: char| !c.is_whitespace() && !c.is_control() && c != '/' && c != ':';
    if fits && name.chars().all(legal) {
        Ok(name.to_owned())
    } else {
        Err(NotALink::NotAnInterfaceName(name.to_owned()))
    }
}

fn socket_address(text: &str) -> Result<SocketAddr, NotALink> {
    let bare = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(text);
    text.parse()
        .or_else(|_| bare.parse::<IpAddr>().map(|address| SocketAddr::new(address, DEFAULT_UDP_PORT)))
        .map_err(|_| NotALink::NotAnAddress(text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_read_as_users_write_them_and_print_back() {
        for (text, printed) in [
            ("raw:eth0", "raw:eth0"),
            ("raw:enp0s31f6.100", "raw:enp0s31f6.100"),
            ("tap:ect0", "tap:ect0"),
            ("udp:127.0.0.1", "udp:127.0.0.1:34980"),
            ("udp:127.0.0.1:5000", "udp:127.0.0.1:5000"),
            ("udp:::1", "udp:[::1]:34980"),
            ("udp:[::1]", "udp:[::1]:34980"),
            ("udp:[::1]:5000", "udp:[::1]:5000"),
        ] {
            let link: LinkSpec = text.parse().unwrap();
            assert_eq!(link.to_string(), printed);
            assert_eq!(printed.parse(), Ok(link));
        }
    }

    #[test]
    fn what_names_no_link_is_refused_with_what_was_expected() {
        for (text, expected) in [
            ("", "raw:IFNAME"),
            ("eth0", "raw:IFNAME"),
            ("pcap:x", "raw:IFNAME"),
            ("raw:", "1 to 15 characters"),
            ("raw:a b", "1 to 15 characters"),
            ("tap:../../etc/passwd", "1 to 15 characters"),
            ("raw:sixteen-letters-", "1 to 15 characters"),
            ("udp:", "an IP address"),
            ("udp:localhost", "an IP address"),
            ("udp:127.0.0.1:70000", "an IP address"),
        ] {
            let error = text.parse::<LinkSpec>().unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
