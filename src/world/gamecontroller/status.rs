//! What a robot says to the referee box: the status packet, by UDP on [`PORT`], 32 bytes.
//!
//! A robot tells where it takes itself and the ball to be. The box forwards it to those who watch the match.

use binrw::io::Cursor;
use binrw::{BinRead, BinWrite, binrw};
use thiserror::Error;

/// The UDP port on which referee boxes hear robots.
pub const PORT: u16 = 3939;
/// The bytes of a status packet.
pub const STATUS_LEN: usize = 32;
/// The version of the status packet, the same in both leagues.
pub const STATUS_VERSION: u8 = 4;

const MAGIC: [u8; 4] = *b"RGrt";
const MM_PER_M: f64 = 1000.0;
/// The age of a ball that was never seen.
const NEVER: f32 = -1.0;

/// A status packet. Lengths are metres here and millimetres on the wire, where they have the precision of an `f32`.
///
/// A referee box takes players 1 to 20 only, and nothing with a NaN in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatusPacket {
    /// The number on the shirt, from 1.
    pub player_number: u8,
    /// The league's number of the team.
    pub team_number: u8,
    /// Lies on the ground and cannot play. Any byte but 0 is read so.
    pub fallen: bool,
    /// m from the centre of the field towards the goal that the robot's team attacks.
    pub x: f32,
    /// m to the left of that direction.
    pub y: f32,
    /// rad, counter-clockwise from the direction of `x`.
    pub theta: f32,
    /// `None` if the robot has not seen the ball yet.
    pub ball: Option<StatusBall>,
}

/// Where a robot saw the ball last, relative to itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatusBall {
    /// s since then. What is below 0 is read as a ball not seen.
    pub age: f32,
    /// m ahead of the robot.
    pub x: f32,
    /// m to the left of the robot.
    pub y: f32,
}

/// Why bytes are not a status packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum StatusError {
    /// It does not begin as status packets do.
    #[error("not a status packet: it does not begin with \"RGrt\" and a version")]
    NotOurs,
    /// Its version is unknown.
    #[error("a status packet of version {0}, where 4 is understood")]
    Version(u8),
    /// It has another length than status packets have.
    #[error("a status packet of {got} bytes, where 32 are needed")]
    Length { got: usize },
}

/// The packet as it crosses the network.
#[binrw]
#[brw(little, magic = b"RGrt")]
struct StatusBytes {
    version: u8,
    player_number: u8,
    team_number: u8,
    fallen: u8,
    pose: [f32; 3],
    ball_age: f32,
    ball: [f32; 2],
}

impl StatusPacket {
    /// The packet in these bytes. Its numbers may be anything that an `f32` can be.
    ///
    /// # Errors
    /// If they are something else, another version, or too short or too long.
    pub fn read(bytes: &[u8]) -> Result<StatusPacket, StatusError> {
        match bytes.split_first_chunk() {
            Some((&MAGIC, [STATUS_VERSION, ..])) => {}
            Some((&MAGIC, [version, ..])) => return Err(StatusError::Version(*version)),
            _ => return Err(StatusError::NotOurs),
        }
        let length = StatusError::Length { got: bytes.len() };
        if bytes.len() != STATUS_LEN {
            return Err(length);
        }
        let wire = StatusBytes::read(&mut Cursor::new(bytes)).map_err(|_| length)?;
        let [x, y, theta] = wire.pose;
        let seen = StatusBall { age: wire.ball_age, x: metres(wire.ball[0]), y: metres(wire.ball[1]) };
        Ok(StatusPacket {
            player_number: wire.player_number,
            team_number: wire.team_number,
            fallen: wire.fallen != 0,
            x: metres(x),
            y: metres(y),
            theta,
            ball: (wire.ball_age >= 0.0).then_some(seen),
        })
    }

    /// The [`STATUS_LEN`] bytes of this packet.
    pub fn write(&self) -> Vec<u8> {
        let ball = self.ball.unwrap_or(StatusBall { age: NEVER, x: 0.0, y: 0.0 });
        let wire = StatusBytes {
            version: STATUS_VERSION,
            player_number: self.player_number,
            team_number: self.team_number,
            fallen: u8::from(self.fallen),
            pose: [millimetres(self.x), millimetres(self.y), self.theta],
            ball_age: ball.age,
            ball: [millimetres(ball.x), millimetres(ball.y)],
        };
        let mut bytes = Cursor::new(Vec::with_capacity(STATUS_LEN));
        // Writing to memory does not fail.
        match wire.write(&mut bytes) {
            Ok(()) => bytes.into_inner(),
            Err(_) => Vec::new(),
        }
    }
}

fn metres(millimetres: f32) -> f32 {
    (f64::from(millimetres) / MM_PER_M) as f32
}

fn millimetres(metres: f32) -> f32 {
    (f64::from(metres) * MM_PER_M) as f32
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn keeper() -> StatusPacket {
        StatusPacket {
            player_number: 1,
            team_number: 9,
            fallen: false,
            x: -4.25,
            y: 0.5,
            theta: 1.5,
            ball: Some(StatusBall { age: 0.25, x: 2.0, y: -1.0 }),
        }
    }

    #[test]
    fn a_status_packet_is_written_in_millimetres() {
        let mut expected = b"RGrt\x04\x01\x09\x00".to_vec();
        for number in [-4250.0f32, 500.0, 1.5, 0.25, 2000.0, -1000.0] {
            expected.extend(number.to_le_bytes());
        }
        assert_eq!(keeper().write(), expected);
        assert_eq!(StatusPacket::read(&expected), Ok(keeper()));
    }

    #[test]
    fn a_ball_that_was_never_seen_has_the_age_minus_one() {
        let packet = StatusPacket { ball: None, fallen: true, ..keeper() };
        let bytes = packet.write();
        assert_eq!((bytes[7], &bytes[20..24]), (1, &(-1.0f32).to_le_bytes()[..]));
        assert_eq!(StatusPacket::read(&bytes), Ok(packet));
        let now = StatusPacket { ball: Some(StatusBall { age: 0.0, x: 1.0, y: 0.0 }), ..packet };
        assert_eq!(StatusPacket::read(&now.write()), Ok(now));
    }

    #[test]
    fn what_is_no_status_packet_is_refused_with_the_reason() {
        let bytes = keeper().write();
        assert_eq!(StatusPacket::read(b"RGme\x04"), Err(StatusError::NotOurs));
        assert_eq!(StatusPacket::read(b"RGrt"), Err(StatusError::NotOurs));
        assert_eq!(StatusPacket::read(b"RGrt\x03"), Err(StatusError::Version(3)));
        assert_eq!(StatusPacket::read(&bytes[..31]), Err(StatusError::Length { got: 31 }));
        assert_eq!(StatusPacket::read(&[bytes, vec![0]].concat()), Err(StatusError::Length { got: 33 }));
    }

    fn near(a: f32, b: f32) -> bool {
        a == b || (a - b).abs() <= a.abs() * 1e-6 + 1e-40
    }

    proptest! {
        #[test]
        fn a_packet_reads_back_as_it_was_written(
            (player_number, team_number, fallen) in any::<(u8, u8, bool)>(),
            (x, y, theta) in (-1e6f32..1e6, -1e6f32..1e6, -7f32..7.0),
            ball in prop::option::of((0f32..1e6, -1e6f32..1e6, -1e6f32..1e6)),
        ) {
            let ball = ball.map(|(age, x, y)| StatusBall { age, x, y });
            let packet = StatusPacket { player_number, team_number, fallen, x, y, theta, ball };
            let read = StatusPacket::read(&packet.write()).unwrap();
            prop_assert!(near(read.x, x) && near(read.y, y), "{packet:?} {read:?}");
            if let (Some(was), Some(is)) = (ball, read.ball) {
                prop_assert!(near(was.x, is.x) && near(was.y, is.y), "{packet:?} {read:?}");
                prop_assert_eq!(was.age, is.age);
            }
            let exact = StatusPacket { x, y, ball, ..read };
            prop_assert_eq!((exact, read.ball.is_some()), (packet, ball.is_some()));
        }

        #[test]
        fn any_32_bytes_with_the_right_beginning_are_read(rest in prop::array::uniform27(any::<u8>())) {
            let bytes = [b"RGrt\x04", &rest[..]].concat();
            let packet = StatusPacket::read(&bytes).unwrap();
            prop_assert_eq!(&packet.write()[..7], &bytes[..7]);
        }
    }
}
