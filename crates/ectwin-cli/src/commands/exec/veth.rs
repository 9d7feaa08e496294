//! A cable: two interfaces of this network namespace, each the end of the other (veth, rtnetlink).

use std::io;

use netlink_packet_core::{
    NLM_F_ACK, NLM_F_CREATE, NLM_F_EXCL, NLM_F_REQUEST, NetlinkHeader, NetlinkMessage, NetlinkPayload,
};
use netlink_packet_route::RouteNetlinkMessage;
use netlink_packet_route::link::{
    InfoData, InfoKind, InfoVeth, LinkAttribute, LinkFlags, LinkInfo, LinkMessage, State,
};
use netlink_sys::protocols::NETLINK_ROUTE;
use netlink_sys::{Socket, SocketAddr};

/// The interface of the master.
pub(super) const MASTER_SIDE: &str = "ectwin0";
/// The interface of the units.
pub(super) const UNIT_SIDE: &str = "ectwin1";
const LOOPBACK: &str = "lo";
/// Multicast group of all changes of links.
const RTNLGRP_LINK: u32 = 1;

/// Makes the cable, and returns when both ends carry frames: before that, the kernel drops them.
pub(super) fn make() -> io::Result<()> {
    let changes = socket()?;
    changes.add_membership(RTNLGRP_LINK)?;
    let kernel = socket()?;
    ask(&kernel, RouteNetlinkMessage::SetLink(up(LOOPBACK)), 0)?;
    ask(&kernel, RouteNetlinkMessage::NewLink(cable()), NLM_F_CREATE | NLM_F_EXCL)?;
    // An end can only be up when there is the other one.
    for end in [MASTER_SIDE, UNIT_SIDE] {
        ask(&kernel, RouteNetlinkMessage::SetLink(up(end)), 0)?;
    }
    wait_until_up(&changes)
}

fn socket() -> io::Result<Socket> {
    let mut socket = Socket::new(NETLINK_ROUTE)?;
    socket.bind_auto()?;
    // The kernel is the other end.
    socket.connect(&SocketAddr::new(0, 0))?;
    Ok(socket)
}

fn interface(name: &str) -> LinkMessage {
    let mut link = LinkMessage::default();
    link.attributes.push(LinkAttribute::IfName(name.to_owned()));
    link
}

/// An interface that is up.
fn up(name: &str) -> LinkMessage {
    let mut link = interface(name);
    link.header.flags = LinkFlags::Up;
    link.header.change_mask = LinkFlags::Up;
    link
}

fn cable() -> LinkMessage {
    let mut link = interface(MASTER_SIDE);
    let peer = InfoData::Veth(InfoVeth::Peer(interface(UNIT_SIDE)));
    link.attributes.push(LinkAttribute::LinkInfo(vec![LinkInfo::Kind(InfoKind::Veth), LinkInfo::Data(peer)]));
    link
}

/// Sends a request, and waits for its acknowledge.
fn ask(kernel: &Socket, request: RouteNetlinkMessage, flags: u16) -> io::Result<()> {
    let mut message = NetlinkMessage::new(NetlinkHeader::default(), NetlinkPayload::from(request));
    message.header.flags = NLM_F_REQUEST | NLM_F_ACK | flags;
    message.finalize();
    let mut bytes = vec![0; message.buffer_len()];
    message.serialize(&mut bytes);
    kernel.send(&bytes, 0)?;
    for answer in messages(kernel)? {
        if let NetlinkPayload::Error(error) = answer.payload {
            return if error.code.is_none() { Ok(()) } else { Err(error.to_io()) };
        }
    }
    Err(io::Error::other("the kernel does not answer"))
}

/// The messages of the next datagram.
fn messages(socket: &Socket) -> io::Result<Vec<NetlinkMessage<RouteNetlinkMessage>>> {
    let (datagram, _) = socket.recv_from_full()?;
    let mut rest = datagram.as_slice();
    let mut messages = Vec::new();
    while !rest.is_empty() {
        let message = NetlinkMessage::<RouteNetlinkMessage>::deserialize(rest).map_err(io::Error::other)?;
        // Messages begin at multiples of 4 bytes.
        let length_bytes = (message.header.length as usize).next_multiple_of(4).max(4);
        rest = rest.get(length_bytes..).unwrap_or_default();
        messages.push(message);
    }
    Ok(messages)
}

fn wait_until_up(changes: &Socket) -> io::Result<()> {
    let mut waiting = vec![MASTER_SIDE, UNIT_SIDE];
    while !waiting.is_empty() {
        for change in messages(changes)? {
            if let NetlinkPayload::InnerMessage(RouteNetlinkMessage::NewLink(link)) = change.payload {
                let is_up = link.attributes.contains(&LinkAttribute::OperState(State::Up));
                let is_it = |name: &str| link.attributes.contains(&LinkAttribute::IfName(name.to_owned()));
                waiting.retain(|name| !(is_up && is_it(name)));
            }
        }
    }
    Ok(())
}
