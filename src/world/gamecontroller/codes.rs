//! The numbers of the protocol and what they mean in each version.
//!
//! The leagues, and the years of one, number set plays and penalties differently. A number without a known meaning is kept as `Other`, so
//! that nothing is lost between reading and writing.

use std::fmt;

use binrw::binrw;
use serde::{Deserialize, Serialize};

/// The version of a control packet, which is also the league that speaks it.
#[binrw]
#[brw(repr = u8)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Version {
    /// Standard Platform League, 2025.
    V18 = 18,
    /// Humanoid Soccer League, the boxes up to 6.
    V19 = 19,
    /// Humanoid Soccer League, the box 7 of RoboCup 2026.
    #[default]
    V20 = 20,
}

/// A number in one version's terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// This number means it.
    Is(u8),
    /// The version has no number for it; this one comes nearest and is written instead.
    Near(u8),
}

use Code::{Is, Near};

/// A meaning and its numbers in the versions 18, 19 and 20.
pub type Row<T> = (T, [Code; 3]);

/// What a byte of the protocol means, by version.
pub trait Coded: Copy + PartialEq + 'static {
    /// All meanings. Within a version no two of them have [the same number](Code::Is).
    const ROWS: &'static [Row<Self>];

    /// A number of unknown meaning.
    fn other(number: u8) -> Self;

    /// The number of an unknown meaning.
    fn number(self) -> Option<u8>;

    /// What a number means in a version.
    fn read(number: u8, version: Version) -> Self {
        let row = Self::ROWS.iter().find(|row| code(row, version) == Is(number));
        row.map_or_else(|| Self::other(number), |row| row.0)
    }

    /// The number that says this in a version, or comes nearest to it.
    fn write(self, version: Version) -> u8 {
        let row = Self::ROWS.iter().find(|row| row.0 == self);
        match row.map(|row| code(row, version)) {
            Some(Is(number) | Near(number)) => number,
            None => self.number().unwrap_or(0),
        }
    }
}

fn code<T>(row: &Row<T>, version: Version) -> Code {
    match version {
        Version::V18 => row.1[0],
        Version::V19 => row.1[1],
        Version::V20 => row.1[2],
    }
}

/// The enumeration with its table: each meaning with its numbers in the versions 18, 19 and 20.
macro_rules! coded {
    ($(#[$doc:meta])* $name:ident { $($(#[$meaning:meta])* $variant:ident: $v18:expr, $v19:expr, $v20:expr;)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name {
            $(
                $(#[$meaning])*
                #[doc = concat!("\n\nVersions 18, 19, 20: ", stringify!($v18), ", ", stringify!($v19), ", ", stringify!($v20), ".")]
                $variant,
            )+
            /// A number of unknown meaning.
            Other(u8),
        }

        impl Coded for $name {
            const ROWS: &'static [Row<$name>] = &[$(($name::$variant, [$v18, $v19, $v20])),+];

            fn other(number: u8) -> $name {
                $name::Other(number)
            }

            fn number(self) -> Option<u8> {
                match self {
                    $name::Other(number) => Some(number),
                    _ => None,
                }
            }
        }

        /// In words: `LocalGameStuck` as `local game stuck`, an unknown number as `code 9`.
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let name = match self {
                    $($name::$variant => stringify!($variant),)+
                    $name::Other(number) => return write!(f, "code {number}"),
                };
                for (place, letter) in name.char_indices() {
                    let space = if place > 0 && letter.is_uppercase() { " " } else { "" };
                    write!(f, "{space}{}", letter.to_ascii_lowercase())?;
                }
                Ok(())
            }
        }
    };
}

coded! {
    /// Where a match stands.
    State {
        Initial: Is(0), Is(0), Is(0);
        /// The robots walk to their kick-off positions.
        Ready: Is(1), Is(1), Is(1);
        /// All stand still.
        Set: Is(2), Is(2), Is(2);
        Playing: Is(3), Is(3), Is(3);
        /// The half, or the match, is over.
        Finished: Is(4), Is(4), Is(4);
        /// The robots watch for the referee's gesture that begins `Ready`. Only in version 18.
        Standby: Is(5), Near(0), Near(0);
    }
}

coded! {
    /// The part of a match.
    GamePhase {
        Normal: Is(0), Is(0), Is(0);
        PenaltyShootOut: Is(1), Is(1), Is(1);
        ExtraTime: Is(2), Is(2), Is(2);
        /// A pause; the state is `Initial` meanwhile.
        TimeOut: Is(3), Is(3), Is(3);
    }
}

coded! {
    /// How the ball comes back into play, other than by a kick-off.
    SetPlay {
        /// None, or a kick-off.
        None: Is(0), Is(0), Is(0);
        GoalKick: Is(1), Is(5), Is(5);
        CornerKick: Is(3), Is(6), Is(6);
        /// From the side line: the kick-in of version 18, the throw-in of the others.
        SideLine: Is(4), Is(4), Is(4);
        PenaltyKick: Is(5), Is(3), Is(3);
        /// After a foul, in version 18.
        PushingFreeKick: Is(2), Near(1), Near(1);
        /// Not in version 18.
        DirectFreeKick: Near(2), Is(1), Is(1);
        /// Not in version 18.
        IndirectFreeKick: Near(2), Is(2), Is(2);
    }
}

coded! {
    /// Why a player is penalised.
    Penalty {
        /// Not penalised.
        None: Is(0), Is(0), Is(0);
        IllegalPosition: Is(5), Is(1), Is(1);
        /// Only in version 18.
        IllegalPositionInSet: Is(9), Near(1), Near(1);
        MotionInSet: Is(3), Is(2), Is(2);
        /// A robot stepped while the play was stopped. Only in version 20.
        MotionInStop: Near(3), Near(2), Is(3);
        /// Only in version 18.
        MotionInStandby: Is(11), Near(2), Near(2);
        LocalGameStuck: Is(8), Is(3), Is(4);
        /// Fallen, inactive or incapable.
        Inactive: Is(4), Is(4), Is(5);
        /// The team asked for the robot to be picked up.
        PickUp: Is(7), Is(5), Is(6);
        /// Held the ball or played it with the hands, in version 18.
        BallContact: Is(1), Near(6), Near(7);
        /// Not in version 18.
        BallHolding: Near(1), Is(6), Is(7);
        LeavingTheField: Is(6), Is(7), Is(8);
        /// Not in version 18.
        ArmsOrHands: Near(1), Is(8), Is(9);
        Pushing: Is(2), Is(9), Is(10);
        /// Stood with the legs too wide, in version 18.
        Stance: Is(10), Near(4), Near(5);
        /// Off the field for a yellow card. Only in version 20.
        Cautioned: Near(2), Near(9), Is(11);
        /// Off the field for good. Not in version 18.
        SentOff: Near(15), Is(10), Is(12);
        /// Not on the field; also in every slot that has no player.
        Substitute: Is(14), Is(11), Is(13);
        /// By the referee's hand, for no named reason. Only in version 18.
        Manual: Is(15), Near(5), Near(6);
    }
}

coded! {
    /// What kind of competition the match belongs to.
    CompetitionType {
        /// The only one of version 18.
        Normal: Is(0), Near(0), Near(0);
        /// Small robots. Not in version 18.
        Small: Near(0), Is(0), Is(0);
        /// Middle-sized robots. Not in version 18.
        Middle: Near(0), Is(1), Is(1);
        /// Large robots. Not in version 18.
        Large: Near(0), Is(2), Is(2);
    }
}

coded! {
    /// Which part of a competition the match belongs to. Only version 18 says.
    CompetitionPhase {
        RoundRobin: Is(0), Is(0), Is(0);
        PlayOff: Is(1), Is(1), Is(1);
    }
}

coded! {
    /// What a player wears.
    Colour {
        Blue: Is(0), Is(0), Is(0);
        Red: Is(1), Is(1), Is(1);
        Yellow: Is(2), Is(2), Is(2);
        Black: Is(3), Is(3), Is(3);
        White: Is(4), Is(4), Is(4);
        Green: Is(5), Is(5), Is(5);
        Orange: Is(6), Is(6), Is(6);
        Purple: Is(7), Is(7), Is(7);
        Brown: Is(8), Is(8), Is(8);
        Grey: Is(9), Is(9), Is(9);
    }
}

/// A byte that stands for yes or no. Any number but 0 is a yes, and is kept.
#[binrw]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Flag(pub u8);

impl Flag {
    /// Whether it is not 0.
    pub const fn is_set(self) -> bool {
        self.0 != 0
    }
}

impl From<bool> for Flag {
    fn from(yes: bool) -> Flag {
        Flag(u8::from(yes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERSIONS: [Version; 3] = Version::ALL;

    fn nothing_is_lost<T: Coded + std::fmt::Debug>() {
        for version in VERSIONS {
            for number in 0..=u8::MAX {
                let meaning = T::read(number, version);
                assert_eq!(meaning.write(version), number, "{meaning:?} in {version:?}");
                assert_eq!(meaning.number().is_some(), meaning == T::other(number));
            }
            for row in T::ROWS {
                match code(row, version) {
                    Is(number) => assert_eq!(T::read(number, version), row.0),
                    Near(number) => assert_ne!(T::read(number, version).number(), Some(number), "{row:?}"),
                }
            }
        }
    }

    #[test]
    fn every_number_is_kept_and_every_meaning_has_a_number() {
        nothing_is_lost::<State>();
        nothing_is_lost::<GamePhase>();
        nothing_is_lost::<SetPlay>();
        nothing_is_lost::<Penalty>();
        nothing_is_lost::<CompetitionType>();
        nothing_is_lost::<CompetitionPhase>();
        nothing_is_lost::<Colour>();
    }

    #[test]
    fn the_versions_number_penalties_differently() {
        let read = |number| VERSIONS.map(|version| Penalty::read(number, version));
        assert_eq!(read(3), [Penalty::MotionInSet, Penalty::LocalGameStuck, Penalty::MotionInStop]);
        assert_eq!(read(4), [Penalty::Inactive, Penalty::Inactive, Penalty::LocalGameStuck]);
        assert_eq!(read(9), [Penalty::IllegalPositionInSet, Penalty::Pushing, Penalty::ArmsOrHands]);
        assert_eq!(read(11), [Penalty::MotionInStandby, Penalty::Substitute, Penalty::Cautioned]);
        assert_eq!(read(14), [Penalty::Substitute, Penalty::Other(14), Penalty::Other(14)]);
        assert_eq!(VERSIONS.map(|version| Penalty::Substitute.write(version)), [14, 11, 13]);
    }

    #[test]
    fn what_a_version_does_not_know_is_written_as_what_comes_nearest() {
        assert_eq!(
            Penalty::read(Penalty::BallHolding.write(Version::V18), Version::V18),
            Penalty::BallContact
        );
        assert_eq!(Penalty::read(Penalty::Cautioned.write(Version::V19), Version::V19), Penalty::Pushing);
        assert_eq!(State::read(State::Standby.write(Version::V19), Version::V19), State::Initial);
        assert_eq!(State::read(5, Version::V19), State::Other(5));
    }

    #[test]
    fn meanings_have_words_and_unknown_ones_their_number() {
        assert_eq!(Penalty::LocalGameStuck.to_string(), "local game stuck");
        assert_eq!(
            (State::Playing.to_string(), State::Other(7).to_string()),
            ("playing".into(), "code 7".into())
        );
    }

    #[test]
    fn any_number_but_0_is_a_yes() {
        assert!(!Flag::from(false).is_set() && Flag::from(true).is_set() && Flag(200).is_set());
    }
}
