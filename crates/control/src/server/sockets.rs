//! The thread that moves lines between the clients and the thread of the requests. It waits for all of them at once.

use std::collections::BTreeMap;
use std::io;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::thread;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::client::{Asked, Client, EXPECTATIONS_OF_ALL_MAX};
use super::notices::Notices;
use super::postbox::{ClientNumber, Post, Postbox};
use super::work::Job;
use crate::messages::{Answer, Refusal};
use crate::socket::Socket;

/// Clients at the same time.
pub const CLIENTS_MAX: usize = 256;
/// How long accepting rests when there is no file descriptor left.
const REST: Duration = Duration::from_millis(100);

/// The clients of a socket.
pub(super) struct Sockets {
    socket: Socket,
    jobs: Sender<Job>,
    postbox: Arc<Postbox>,
    clients: BTreeMap<ClientNumber, Client>,
    next_number: ClientNumber,
    notices: Notices,
}

/// What is ready.
#[derive(Default)]
struct Ready {
    has_new_client: bool,
    clients: Vec<(ClientNumber, PollFlags)>,
}

impl Sockets {
    pub(super) fn new(socket: Socket, jobs: Sender<Job>, postbox: Arc<Postbox>) -> Self {
        Self { socket, jobs, postbox, clients: BTreeMap::new(), next_number: 1, notices: Notices::default() }
    }

    pub(super) fn run(mut self) {
        while !self.postbox.is_stopped() {
            match self.wait() {
                Ok(ready) => self.turn(&ready),
                Err(error) => {
                    tracing::error!("control: clients cannot be awaited: {error}");
                    thread::sleep(REST);
                }
            }
        }
        // What was answered before the end is still delivered to those that take it.
        self.deliver();
    }

    fn turn(&mut self, ready: &Ready) {
        self.deliver();
        if ready.has_new_client {
            self.accept();
        }
        for (number, flags) in &ready.clients {
            if let Some(client) = self.clients.get_mut(number) {
                attend(client, *flags);
            }
        }
        self.hand_on();
        self.clients.values_mut().for_each(Client::write);
        self.forget_those_that_are_done();
    }

    /// Waits until something is ready.
    fn wait(&self) -> io::Result<Ready> {
        let mut numbers = Vec::with_capacity(self.clients.len());
        let mut awaited = Vec::with_capacity(self.clients.len() + 2);
        awaited.push(PollFd::new(&self.postbox.wake, PollFlags::IN));
        awaited.push(PollFd::new(&self.socket.listener, PollFlags::IN));
        for client in self.clients.values() {
            let Some(flags) = client.awaited() else { continue };
            numbers.push(client.number);
            awaited.push(PollFd::new(&client.stream, flags));
        }
        let has_work = self.clients.values().any(Client::can_ask);
        let at_once = Timespec::default();
        match poll(&mut awaited, has_work.then_some(&at_once)) {
            Ok(_) | Err(Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
        let mut flags = awaited.iter().skip(1).map(PollFd::revents);
        let has_new_client = flags.next().is_some_and(|flags| !flags.is_empty());
        let clients = numbers.into_iter().zip(flags).filter(|(_, flags)| !flags.is_empty()).collect();
        Ok(Ready { has_new_client, clients })
    }

    /// Gives the clients what was posted for them.
    fn deliver(&mut self) {
        for post in self.postbox.take() {
            match post {
                Post::Answer { client, line, ends, subscription } => {
                    if let Some(client) = self.clients.get_mut(&client) {
                        client.answer(line, ends, subscription);
                    }
                }
                Post::Record { kind, line } => {
                    self.clients.values_mut().for_each(|client| client.record(kind, &line));
                }
                Post::RecordFor { client, line } => {
                    self.clients
                        .get_mut(&client)
                        .into_iter()
                        .for_each(|client| client.own_record(line.clone()));
                }
                Post::Lost(count) => self.clients.values_mut().for_each(|client| client.lose(count)),
            }
        }
        self.clients.values_mut().for_each(Client::write);
    }

    fn accept(&mut self) {
        loop {
            match self.socket.listener.accept() {
                Ok((stream, _)) => self.admit(stream),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return,
                Err(error) => {
                    if self.notices.may_show() {
                        tracing::warn!("control: a client cannot be accepted: {error}");
                    }
                    // Without a file descriptor the same client would be reported at once.
                    thread::sleep(REST);
                    return;
                }
            }
        }
    }

    fn admit(&mut self, stream: UnixStream) {
        if stream.set_nonblocking(true).is_err() {
            return;
        }
        let mut client = Client::new(self.next_number, stream);
        self.next_number += 1;
        if self.clients.len() >= CLIENTS_MAX {
            let refusal = Refusal::new(
                format!("{CLIENTS_MAX} clients are connected already"),
                "close one of them, and connect again",
            );
            client.refuse(&Answer::refused(serde_json::Value::Null, refusal));
            if self.notices.may_show() {
                tracing::warn!("control: a client was refused: {CLIENTS_MAX} are connected");
            }
            return;
        }
        self.clients.insert(client.number, client);
    }

    /// Hands on the requests of the clients.
    fn hand_on(&mut self) {
        let Self { clients, jobs, notices, .. } = self;
        let mut waiting: usize = clients.values().map(Client::expectations).sum();
        for client in clients.values_mut() {
            let before = client.expectations();
            let room = EXPECTATIONS_OF_ALL_MAX.saturating_sub(waiting);
            client.requests(room, |client, asked| match asked {
                // At the end of the twin nobody takes it.
                Asked::Request { request, is_there } => {
                    drop(jobs.send(Job::Request { client, request, is_there }));
                }
                Asked::Refused(refusal) => {
                    if notices.may_show() {
                        tracing::warn!("control: client {client}: {refusal}");
                    }
                }
            });
            waiting += client.expectations() - before;
        }
    }

    fn forget_those_that_are_done(&mut self) {
        let Self { clients, jobs, .. } = self;
        clients.retain(|number, client| {
            let is_done = client.is_done();
            if is_done {
                drop(jobs.send(Job::Gone { client: *number }));
            }
            !is_done
        });
    }
}

fn attend(client: &mut Client, flags: PollFlags) {
    if flags.contains(PollFlags::IN) {
        client.receive();
    } else if flags.intersects(PollFlags::HUP | PollFlags::ERR) {
        // Everything that it has sent has been received.
        client.leave();
    }
}
