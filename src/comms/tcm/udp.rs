//! An easy layer over the sockets of the operating system (TeamChaos, section 3, the UDPConn).

use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use super::fragments::LARGEST_DATAGRAM;

/// A bound UDP socket that never blocks unless asked to.
#[derive(Debug)]
pub struct UdpConn {
    socket: UdpSocket,
    address: SocketAddr,
    /// One byte longer than the longest datagram that is taken: a longer one fills it.
    buffer: Box<[u8]>,
    oversized: u64,
    dropped: u64,
}

/// What the operating system refused, and for which address.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum UdpError {
    /// The socket cannot be opened.
    #[error("cannot listen at {address}: {}", why(source))]
    Bind { address: SocketAddr, source: io::Error },
    /// A datagram cannot be sent.
    #[error("cannot send to {to}: {source}")]
    Send { to: SocketAddr, source: io::Error },
    /// Datagrams cannot be received.
    #[error("cannot receive at {at}: {source}")]
    Receive { at: SocketAddr, source: io::Error },
}

fn why(source: &io::Error) -> String {
    match source.kind() {
        ErrorKind::AddrInUse => "the port is taken, perhaps by another match or one of its robots".into(),
        _ => source.to_string(),
    }
}

/// The result of one try to receive.
enum Step {
    Datagram(SocketAddr, usize),
    /// Something that is not for the caller: an oversized datagram, or word that an earlier one found nobody.
    Skip,
    Nothing,
}

/// How many datagrams and errors that are not for the caller one call skips at most.
const SKIPS: usize = 64;

/// What Windows says of a datagram that is longer than the buffer.
const WSAEMSGSIZE: i32 = 10_040;

impl UdpConn {
    /// Listens at an address; port 0 is any that is free. Takes datagrams of any size.
    ///
    /// # Errors
    /// If the address is taken or is not one of this machine.
    pub fn bind(address: SocketAddr) -> Result<UdpConn, UdpError> {
        UdpConn::bind_for(address, LARGEST_DATAGRAM)
    }

    /// As [`UdpConn::bind`], but takes datagrams of up to `largest` bytes only.
    ///
    /// # Errors
    /// If the address is taken or is not one of this machine.
    pub fn bind_for(address: SocketAddr, largest: usize) -> Result<UdpConn, UdpError> {
        let open = || {
            let socket = UdpSocket::bind(address)?;
            socket.set_nonblocking(true)?;
            let address = socket.local_addr()?;
            Ok((socket, address))
        };
        let (socket, address) = open().map_err(|source| UdpError::Bind { address, source })?;
        let buffer = vec![0; largest.min(LARGEST_DATAGRAM) + 1].into();
        Ok(UdpConn { socket, address, buffer, oversized: 0, dropped: 0 })
    }

    /// Sends to any address of the kind of this one, from a port that is free: to other machines, too, and by broadcast.
    ///
    /// # Errors
    /// If this machine has no addresses of that kind.
    pub fn speaker(to: SocketAddr) -> Result<UdpConn, UdpError> {
        let any: IpAddr =
            if to.is_ipv4() { Ipv4Addr::UNSPECIFIED.into() } else { Ipv6Addr::UNSPECIFIED.into() };
        let conn = UdpConn::bind(SocketAddr::new(any, 0))?;
        let source = conn.socket.set_broadcast(true);
        source.map_err(|source| UdpError::Send { to, source })?;
        Ok(conn)
    }

    /// Where it listens, with the port that was free if 0 was asked for.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Datagrams that were longer than what is taken. They are malformed, whatever they begin with.
    pub fn oversized(&self) -> u64 {
        self.oversized
    }

    /// Datagrams that the operating system had no room to send.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Sends a datagram; whether it arrives, nobody tells. One that the operating system has no room for is dropped and
    /// counted.
    ///
    /// # Errors
    /// If the address cannot be reached from this socket, or the datagram is too large.
    pub fn send(&mut self, to: SocketAddr, bytes: &[u8]) -> Result<(), UdpError> {
        for _ in 0..SKIPS {
            match self.socket.send_to(bytes, to) {
                Ok(_) => return Ok(()),
                Err(error) if is_about_another(&error) => {}
                Err(error) if is_for_want_of_room(&error) => break,
                Err(source) => return Err(UdpError::Send { to, source }),
            }
        }
        self.dropped += 1;
        Ok(())
    }

    /// A datagram that has arrived, with its sender; `None` if there is none now.
    ///
    /// # Errors
    /// If the socket does not work any more.
    pub fn receive(&mut self) -> Result<Option<(SocketAddr, &[u8])>, UdpError> {
        for _ in 0..SKIPS {
            match self.step()? {
                Step::Datagram(from, length) => return Ok(Some((from, &self.buffer[..length]))),
                Step::Skip => {}
                Step::Nothing => break,
            }
        }
        Ok(None)
    }

    /// As [`UdpConn::receive`], but waits for a datagram for as long as `patience`.
    ///
    /// # Errors
    /// If the socket does not work any more.
    pub fn wait(&mut self, patience: Duration) -> Result<Option<(SocketAddr, &[u8])>, UdpError> {
        let begin = Instant::now();
        loop {
            let left = patience.saturating_sub(begin.elapsed());
            if left.is_zero() {
                return self.receive();
            }
            if let Some((from, length)) = self.blocking_step(left)? {
                return Ok(Some((from, &self.buffer[..length])));
            }
        }
    }

    fn blocking_step(&mut self, patience: Duration) -> Result<Option<(SocketAddr, usize)>, UdpError> {
        let at = self.address;
        let receive = |source| UdpError::Receive { at, source };
        // Some systems round the time down, and none takes 0.
        let patience = patience.max(Duration::from_millis(1));
        self.socket.set_read_timeout(Some(patience)).map_err(receive)?;
        self.socket.set_nonblocking(false).map_err(receive)?;
        let step = self.step();
        self.socket.set_nonblocking(true).map_err(receive)?;
        match step? {
            Step::Datagram(from, length) => Ok(Some((from, length))),
            Step::Skip | Step::Nothing => Ok(None),
        }
    }

    fn step(&mut self) -> Result<Step, UdpError> {
        match self.socket.recv_from(&mut self.buffer) {
            Ok((length, from)) if length < self.buffer.len() => Ok(Step::Datagram(from, length)),
            Ok(_) => {
                self.oversized += 1;
                Ok(Step::Skip)
            }
            Err(error) if error.raw_os_error() == Some(WSAEMSGSIZE) => {
                self.oversized += 1;
                Ok(Step::Skip)
            }
            Err(error) if is_about_another(&error) => Ok(Step::Skip),
            Err(error) if is_for_want_of_room(&error) || error.kind() == ErrorKind::TimedOut => {
                Ok(Step::Nothing)
            }
            Err(source) => Err(UdpError::Receive { at: self.address, source }),
        }
    }
}

/// Whether an error is a signal, or word that a datagram sent earlier found nobody.
fn is_about_another(error: &io::Error) -> bool {
    use ErrorKind::{ConnectionRefused, ConnectionReset, Interrupted};
    matches!(error.kind(), Interrupted | ConnectionRefused | ConnectionReset)
}

fn is_for_want_of_room(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::OutOfMemory)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATIENCE: Duration = Duration::from_secs(5);

    fn any_port() -> SocketAddr {
        SocketAddr::from(([127, 0, 0, 1], 0))
    }

    fn conn() -> UdpConn {
        UdpConn::bind(any_port()).unwrap()
    }

    #[test]
    fn datagrams_arrive_whole_and_with_their_sender() {
        let (mut one, mut other) = (conn(), conn());
        assert_eq!(other.receive().unwrap(), None);
        one.send(other.address(), b"hello").unwrap();
        one.send(other.address(), b"").unwrap();
        assert_eq!(other.wait(PATIENCE).unwrap(), Some((one.address(), &b"hello"[..])));
        assert_eq!(other.wait(PATIENCE).unwrap(), Some((one.address(), &b""[..])));
        assert_eq!(other.receive().unwrap(), None);
    }

    #[test]
    fn waiting_ends() {
        let mut conn = conn();
        let begin = Instant::now();
        assert_eq!(conn.wait(Duration::from_millis(20)).unwrap(), None);
        assert!(begin.elapsed() >= Duration::from_millis(15));
        assert_eq!(conn.wait(Duration::ZERO).unwrap(), None);
    }

    #[test]
    fn the_largest_datagram_arrives() {
        let (mut one, mut other) = (conn(), conn());
        one.send(other.address(), &vec![7; LARGEST_DATAGRAM]).unwrap();
        let (_, bytes) = other.wait(PATIENCE).unwrap().unwrap();
        assert_eq!(bytes.len(), LARGEST_DATAGRAM);
        let error = one.send(other.address(), &vec![7; LARGEST_DATAGRAM + 1]).unwrap_err();
        assert!(error.to_string().contains(&other.address().to_string()), "{error}");
    }

    #[test]
    fn what_is_longer_than_the_buffer_is_counted_and_not_cut_short() {
        let (mut one, mut other) = (conn(), UdpConn::bind_for(any_port(), 4).unwrap());
        for bytes in [&b"12345"[..], b"123456", b"1234"] {
            one.send(other.address(), bytes).unwrap();
        }
        assert_eq!(other.wait(PATIENCE).unwrap().map(|(_, bytes)| bytes.to_vec()), Some(b"1234".to_vec()));
        assert_eq!(other.oversized(), 2);
    }

    #[test]
    fn nobody_at_the_other_end_is_no_error() {
        let mut one = conn();
        let gone = conn().address();
        for _ in 0..3 {
            one.send(gone, b"hello").unwrap();
            assert_eq!(one.wait(Duration::from_millis(2)).unwrap(), None);
        }
    }

    #[test]
    fn a_connected_socket_hears_of_a_refusal_and_goes_on() {
        let mut one = conn();
        let gone = conn().address();
        // As connecting makes Linux report what ICMP says.
        one.socket.connect(gone).unwrap();
        one.send(gone, b"hello").unwrap();
        assert_eq!(one.wait(Duration::from_millis(20)).unwrap(), None);
        one.send(gone, b"hello").unwrap();
        one.send(gone, b"hello").unwrap();
    }

    #[test]
    fn a_speaker_reaches_ipv6_and_broadcast_addresses() {
        let ears = |at: &str| UdpConn::bind(at.parse().unwrap()).unwrap();
        for (listens, host) in
            [("127.0.0.1:0", "127.0.0.1"), ("0.0.0.0:0", "127.255.255.255"), ("[::1]:0", "::1")]
        {
            let mut ears = ears(listens);
            let to = SocketAddr::new(host.parse().unwrap(), ears.address().port());
            UdpConn::speaker(to).unwrap().send(to, b"hello").unwrap();
            let heard = ears.wait(PATIENCE).unwrap().map(|(_, bytes)| bytes.to_vec());
            assert_eq!(heard.as_deref(), Some(&b"hello"[..]), "{host}");
        }
    }

    #[test]
    fn an_address_that_is_taken_is_named() {
        let one = conn();
        let error = UdpConn::bind(one.address()).unwrap_err();
        assert!(error.to_string().contains(&one.address().to_string()), "{error}");
    }
}
