//! What is measured of a match: each figure with its name, its unit and one sentence that says what it is.

use bevy::prelude::World;
use serde::{Deserialize, Serialize};

use crate::comms::radio::{LinkCounters, Loss, RadioRecord};
use crate::game::Match;
use crate::game::record::{AGGLOMERATION, CROWD, Invariants, Record};
use crate::ids::{RobotId, Team};
use crate::lab::statistics::{mean, median, quantile};
use crate::mind::teamwork::{LockRequests, SwapAttempts, Swapping};
use crate::world::referee::RemovalReason;

/// What the figures are taken from.
#[derive(Clone, Copy)]
pub struct MatchFigures<'a> {
    record: &'a Record,
    radio: &'a RadioRecord,
    /// Home first.
    score: [u32; 2],
    invariants: &'a Invariants,
    /// What became of the role swaps that robots have begun, home first.
    swaps: [SwapFigures; 2],
    /// Length of a tick, s.
    dt: f64,
}

/// The role swaps of a team, as those who began them and those who were asked for their locks know.
#[derive(Clone, Copy, Default)]
struct SwapFigures {
    attempts: SwapAttempts,
    requests: LockRequests,
}

impl<'a> MatchFigures<'a> {
    /// Those of a match so far.
    pub fn of(game: &'a Match) -> MatchFigures<'a> {
        let radio = game.world().resource::<RadioRecord>();
        let invariants = game.world().resource::<Invariants>();
        let (swaps, dt) = (swaps(game.world()), game.clock().dt.into());
        MatchFigures { record: game.record(), radio, score: game.state().score, invariants, swaps, dt }
    }

    /// A part of the time of play.
    fn share(&self, seconds: f64) -> f64 {
        ratio(seconds, self.record.played)
    }

    fn per_minute(&self, number: impl Into<f64>) -> f64 {
        60.0 * self.share(number.into())
    }

    fn sent_by(&self, team: Team) -> LinkCounters {
        self.radio.sum(|from, _, _| from.team == team)
    }

    fn goals_ahead(&self, team: Team) -> f64 {
        f64::from(self.score[team.index()]) - f64::from(self.score[team.opponent().index()])
    }

    /// How often the team, or neither of both, broke an invariant.
    fn broken(&self, team: Team) -> f64 {
        let own = self.invariants.broken.iter().filter(|((_, of), _)| of.is_none_or(|of| of == team));
        f64::from(own.map(|(_, count)| count.times).sum::<u32>())
    }

    /// Of the packets that a team sent, the share that was lost to a cause.
    fn lost_to(&self, team: Team, cause: Loss) -> f64 {
        let sent = self.sent_by(team);
        ratio(count(sent.lost[cause.index()]), count(sent.sent))
    }

    /// How long it took each time until somebody drove at the ball again, s.
    fn driver_replacements(&self, team: Team) -> &[f64] {
        &self.record.pursuit[team.index()].replacement.seconds
    }

    /// How long it took each time until somebody went again in the robots' eyes, s.
    fn booker_replacements(&self, team: Team) -> &[f64] {
        &self.record.bookings[team.index()].replacement.seconds
    }

    /// The role swaps that its robots began.
    fn attempts(&self, team: Team) -> SwapAttempts {
        self.swaps[team.index()].attempts
    }

    /// The locks that its robots were asked for.
    fn requests(&self, team: Team) -> LockRequests {
        self.swaps[team.index()].requests
    }

    fn removed(&self, team: Team, reason: RemovalReason) -> f64 {
        self.record.removals.count(reason)[team.index()].into()
    }
}

/// Of nothing it is 0.
fn ratio(part: f64, whole: f64) -> f64 {
    some_ratio(part, whole).unwrap_or(0.0)
}

/// Of nothing there is none.
fn some_ratio(part: impl Into<f64>, whole: impl Into<f64>) -> Option<f64> {
    let (part, whole) = (part.into(), whole.into());
    (whole > 0.0).then(|| part / whole)
}

fn swaps(world: &World) -> [SwapFigures; 2] {
    let mut swaps = [SwapFigures::default(); 2];
    if let Some(mut robots) = world.try_query::<(&RobotId, &Swapping)>() {
        for (id, swapping) in robots.iter(world) {
            let of = &mut swaps[id.team.index()];
            of.attempts += swapping.attempts;
            of.requests += swapping.requests;
        }
    }
    swaps
}

/// As a double, which holds every count of a match.
fn count(number: u64) -> f64 {
    number as f64
}

/// Defines the figures, all in one table.
macro_rules! metrics {
    ($($name:ident $column:literal [$unit:literal] $says:literal ($figures:ident, $team:ident) $value:expr;)*) => {
        /// A figure of one team in one match.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        pub enum Metric {
            $(#[doc = $says] $name,)*
        }

        impl Metric {
            /// All of them, in the order of the columns of a table.
            pub const ALL: &'static [Metric] = &[$(Metric::$name),*];

            /// The name of its column in tables.
            pub fn column(self) -> &'static str {
                match self { $(Metric::$name => $column,)* }
            }

            /// Its unit; empty for numbers and shares.
            pub fn unit(self) -> &'static str {
                match self { $(Metric::$name => $unit,)* }
            }

            /// What it is, in a sentence.
            pub fn says(self) -> &'static str {
                match self { $(Metric::$name => $says,)* }
            }

            /// Its value for a team, if the match has one: what never happened did not take any time.
            pub fn value(self, figures: MatchFigures, team: Team) -> Option<f64> {
                match self {
                    $(Metric::$name => {
                        let ($figures, $team) = (figures, team);
                        Option::<f64>::from($value)
                    })*
                }
            }
        }
    };
}

metrics! {
    Goals "goals" [""] "Goals that the team scored." (m, team) f64::from(m.score[team.index()]);
    GoalsAgainst "goals_against" [""] "Goals that the other team scored." (m, team) {
        f64::from(m.score[team.opponent().index()])
    };
    GoalDifference "goal_difference" [""] "Its goals less those against it." (m, team) m.goals_ahead(team);
    Points "points" [""] "1 for a match that it won, a half for a draw." (m, team) {
        (m.goals_ahead(team).clamp(-1.0, 1.0) + 1.0) / 2.0
    };
    Possession "possession" [""] "Of the time in which either team had the ball, the share in which it had." (m, team)
        m.record.possession_shares()[team.index()];
    Territory "territory" ["m"] "Where the ball was in the mean, towards the goal that the team attacks." (m, team) {
        m.share(m.record.places.territory(team))
    };
    Undefended "undefended" [""] "Share of play in which fewer than two of its robots were on their goal's side of the ball." (m, team)
        m.share(m.record.places.undefended(team));
    GoalUnguarded "goal_unguarded" [""] "Share of play in which none of its robots was on their goal's side of the ball." (m, team)
        m.share(m.record.places.unguarded(team));
    TwoInArea "two_in_area" [""] "Share of play with two or more of its robots in their own penalty area." (m, team)
        m.share(m.record.places.two_in_area(team));
    Crowding "crowding" [""] "Share of play with two or more of its robots within a metre of the ball." (m, team)
        m.share(m.record.crowding.seconds(CROWD)[team.index()]);
    Agglomeration "agglomeration" [""] "Share of play with two or more of its robots within half a metre of the ball." (m, team)
        m.share(m.record.crowding.seconds(AGGLOMERATION)[team.index()]);
    NearBall "near_ball" [""] "How many of its robots were within a metre of the ball in the mean." (m, team)
        m.share(m.record.places.near_ball(team));
    MateDistance "mate_distance" ["m"] "How far its robots were from their nearest team mate in the mean." (m, team)
        m.record.places.mate_distance(team);
    MateContacts "mate_contacts" ["1/min"] "How often two of its robots touched, for a minute of play." (m, team)
        m.per_minute(m.record.contacts.of_mates(team).number);
    MateContactTime "mate_contact_time" ["s/min"] "How long pairs of its robots touched, for a minute of play." (m, team)
        m.per_minute(m.record.contacts.of_mates(team).seconds);
    OpponentContacts "opponent_contacts" ["1/min"] "How often robots of both teams touched, for a minute of play." (m, _team)
        m.per_minute(m.record.contacts.of_opponents().number);
    NobodyDrives "nobody_drives" [""] "Share of play in which none of its robots drove at the ball." (m, team)
        m.share(m.record.pursuit[team.index()].nobody.total);
    NobodyDrivesLongest "nobody_drives_longest" ["s"] "Longest time in which none of its robots drove at the ball." (m, team)
        m.record.pursuit[team.index()].nobody.longest;
    OneDrives "one_drives" [""] "Share of play in which exactly one of its robots drove at the ball." (m, team)
        m.share(m.record.pursuit[team.index()].one.total);
    SeveralDrive "several_drive" [""] "Share of play in which two or more of its robots drove at the ball." (m, team)
        m.share(m.record.pursuit[team.index()].several.total);
    FartherDrives "farther_drives" [""] "Share of play in which one robot drove at the ball while a mate was nearer." (m, team)
        m.share(m.record.pursuit[team.index()].farther.total);
    Takeovers "takeovers" ["1/min"] "How often another robot became the one that drives at the ball, for a minute." (m, team)
        m.per_minute(count(m.record.pursuit[team.index()].takeovers));
    Alternations "alternations" ["1/min"] "Takeovers back to the robot before within 3 s, for a minute of play." (m, team)
        m.per_minute(count(m.record.pursuit[team.index()].alternations));
    ReplacementTime "replacement_time" ["s"] "How long nobody drove at the ball after the only one that did was switched off or taken off." (m, team)
        mean(m.driver_replacements(team));
    ReplacementTimeLongest "replacement_time_longest" ["s"] "The longest time that nobody drove at the ball after the only one that did was switched off or taken off." (m, team)
        quantile(m.driver_replacements(team), 1.0);
    BelievedNobody "believed_nobody" [""] "Share of play in which a robot of a booking team knew the ball and none believed to go." (m, team)
        m.share(m.record.bookings[team.index()].nobody_goes.total);
    BelievedNobodyLongest "believed_nobody_longest" ["s"] "Longest time in which a robot knew the ball and none believed to go." (m, team)
        m.record.bookings[team.index()].nobody_goes.longest;
    BookerReplacementTime "booker_replacement_time" ["s"] "How long nobody went, in the robots' eyes, after the only one that did was switched off while another knew the ball." (m, team)
        mean(m.booker_replacements(team));
    BookerReplacementTimeMedian "booker_replacement_time_median" ["s"] "The median of these times." (m, team)
        median(m.booker_replacements(team));
    BookerReplacementTimeP95 "booker_replacement_time_p95" ["s"] "Their 95th percentile." (m, team)
        quantile(m.booker_replacements(team), 0.95);
    BookerReplacementTimeLongest "booker_replacement_time_longest" ["s"] "The longest time that nobody went, in the robots' eyes, after the only one that did was switched off while another knew the ball." (m, team)
        quantile(m.booker_replacements(team), 1.0);
    BelievedSeveral "believed_several" [""] "Share of play in which several robots of a booking team believed to go." (m, team)
        m.share(m.record.bookings[team.index()].several_go.total);
    LooseBallsWon "loose_balls_won" ["1/min"] "Balls that nobody had touched for a second and that it got, for a minute." (m, team)
        m.per_minute(m.record.loose_balls.won[team.index()]);
    PlaceLost "place_lost" [""] "Share of its robots' time of play in which they were over 0.5 m from where they believed to be." (m, team) {
        let localisation = &m.record.localisation[team.index()];
        ratio(localisation.lost, localisation.robots)
    };
    PlaceRecoveries "place_recoveries" ["1/min"] "How often a robot that was over 0.5 m from where it believed to be came to within 0.25 m, for a minute." (m, team)
        m.per_minute(m.record.localisation[team.index()].recoveries);
    PlaceRecoveryTime "place_recovery_time" ["s"] "How long it took in the mean from over 0.5 m to within 0.25 m of where it believed to be, as after a kidnapping." (m, team) {
        let localisation = &m.record.localisation[team.index()];
        some_ratio(localisation.recovering, localisation.recoveries)
    };
    KicksTried "kicks_tried" ["1/min"] "Kicks that it began, for a minute of play." (m, team)
        m.per_minute(m.record.kicks[team.index()].tried);
    KicksStruck "kicks_struck" ["1/min"] "Kicks that met the ball, for a minute of play." (m, team)
        m.per_minute(m.record.kicks[team.index()].struck);
    KicksMissed "kicks_missed" ["1/min"] "Kicks that met nothing, for a minute of play." (m, team)
        m.per_minute(m.record.kicks[team.index()].missed);
    BallsCaught "balls_caught" ["1/min"] "Balls that its chins got hold of, for a minute of play." (m, team)
        m.per_minute(m.record.grips[team.index()].caught);
    BallsSlipped "balls_slipped" ["1/min"] "Balls that its chins lost to others, for a minute of play." (m, team)
        m.per_minute(m.record.grips[team.index()].slipped);
    Falls "falls" [""] "How often its robots fell." (m, team) f64::from(m.record.falls[team.index()]);
    RoleChanges "role_changes" ["1/min"] "How often its robots changed their role, for a minute of play." (m, team)
        m.per_minute(count(m.record.roles[team.index()].changes));
    RoleHold "role_hold" ["s"] "How long its robots kept a role in the mean." (m, team) m.record.roles[team.index()].mean;
    RoleOscillations "role_oscillations" ["1/min"] "Role changes that went back within 3 s, for a minute of play." (m, team)
        m.per_minute(count(m.record.roles[team.index()].oscillations));
    RoleVacant "role_vacant" [""] "Share of play in which a role of the kick-off was played by nobody." (m, team)
        m.share(m.record.role_cover[team.index()].vacant.total);
    RoleVacantLongest "role_vacant_longest" ["s"] "Longest time in which a role of the kick-off was played by nobody." (m, team)
        m.record.role_cover[team.index()].vacant.longest;
    RoleDoubled "role_doubled" [""] "Share of play in which more robots played a role than at the kick-off." (m, team)
        m.share(m.record.role_cover[team.index()].doubled.total);
    RoleDoubledLongest "role_doubled_longest" ["s"] "Longest time in which more robots played a role than at the kick-off." (m, team)
        m.record.role_cover[team.index()].doubled.longest;
    SwapsBegun "swaps_begun" ["1/min"] "Role swaps that its robots began, for a minute of play." (m, team)
        m.per_minute(m.attempts(team).begun);
    SwapsCompleted "swaps_completed" [""] "Share of them that their initiators saw acknowledged by all." (m, team)
        some_ratio(m.attempts(team).completed, m.attempts(team).begun);
    SwapsWithoutLocks "swaps_without_locks" [""] "Share of them in which not everybody's lock came in time." (m, team)
        some_ratio(m.attempts(team).without_locks, m.attempts(team).begun);
    SwapsWithoutAcks "swaps_without_acks" [""] "Share of them in which all were locked and not every new role was acknowledged in time." (m, team)
        some_ratio(m.attempts(team).without_acks, m.attempts(team).begun);
    SwapTime "swap_time" ["s"] "How long the completed ones took in the mean, from the first LOCK to the last ACKSWAP." (m, team)
        some_ratio(count(m.attempts(team).ticks) * m.dt, m.attempts(team).completed);
    LocksAsked "locks_asked" ["1/min"] "LOCKs of mates that reached its robots, for a minute of play." (m, team)
        m.per_minute(m.requests(team).received);
    LocksGranted "locks_granted" [""] "Share of them that were answered with a lock; the others were refused." (m, team)
        some_ratio(m.requests(team).granted, m.requests(team).received);
    LocksRunOut "locks_run_out" [""] "Share of the locks given that ran out before a new role came." (m, team)
        some_ratio(m.requests(team).ran_out, m.requests(team).granted);
    InvariantsBroken "invariants_broken" [""] "How often something did not hold for too long that must hold of every match." (m, team)
        m.broken(team);
    StateChanges "state_changes" ["1/min"] "How often its robots changed the state of their machine, for a minute." (m, team)
        m.per_minute(count(m.record.states[team.index()].changes));
    StateOscillations "state_oscillations" ["1/min"] "State changes that went back within 3 s, for a minute of play." (m, team)
        m.per_minute(count(m.record.states[team.index()].oscillations));
    Driven "driven" ["m/min"] "Metres that its robots drove together, for a minute of play." (m, team)
        m.per_minute(m.record.driven_by(team));
    PacketsSent "packets_sent" ["1/s"] "Packets that its robots sent, one for each receiver, for a second of play." (m, team)
        m.share(count(m.sent_by(team).sent));
    PacketsDelivered "packets_delivered" [""] "Share of its packets that arrived." (m, team)
        ratio(count(m.sent_by(team).delivered), count(m.sent_by(team).sent));
    PacketsLost "packets_lost" [""] "Share of its packets that were lost." (m, team)
        ratio(count(m.sent_by(team).lost_in_all()), count(m.sent_by(team).sent));
    LostToChance "lost_to_chance" [""] "Share of its packets that were lost to the radio's own loss." (m, team)
        m.lost_to(team, Loss::Chance);
    LostToInterference "lost_to_interference" [""] "Share of its packets that were lost to interference or a jammed band." (m, team)
        m.lost_to(team, Loss::Extra) + m.lost_to(team, Loss::Jammed);
    LostOnAir "lost_on_air" [""] "Share of its packets that were lost to the channel that all share: overlapping frames, or too many waiting." (m, team)
        m.lost_to(team, Loss::Air);
    LostToRange "lost_to_range" [""] "Share of its packets that were lost since the receiver was too far away." (m, team)
        m.lost_to(team, Loss::Range);
    LostToBudget "lost_to_budget" [""] "Share of its packets that were not sent since the radio's budget was used up." (m, team)
        m.lost_to(team, Loss::Budget);
    LostToFaults "lost_to_faults" [""] "Share of its packets that were lost to faults of robots or links: mute, deaf, cut off, by rule." (m, team) {
        [Loss::Mute, Loss::Deaf, Loss::CutOff, Loss::Fault].map(|cause| m.lost_to(team, cause)).iter().sum::<f64>()
    };
    PacketsLate "packets_late" [""] "Share of its packets that took longer than the radio's ordinary delay." (m, team)
        ratio(count(m.sent_by(team).late), count(m.sent_by(team).sent));
    BytesSent "bytes_sent" ["B/s"] "Bytes of the packets that it sent, for a second of play." (m, team)
        m.share(count(m.sent_by(team).bytes));
    NoProgress "no_progress" ["1/min"] "How often the referee began anew since nothing came of play, for a minute." (m, _team)
        m.per_minute(m.record.no_progress);
    SecondDefenders "second_defenders" [""] "Robots taken off for staying in their own area beside a mate." (m, team)
        m.removed(team, RemovalReason::SecondDefender);
    IllegalDefenders "illegal_defenders" [""] "Robots taken off for being in their own area." (m, team)
        m.removed(team, RemovalReason::IllegalDefender);
    BallHoldings "ball_holdings" [""] "Robots taken off for holding or carrying the ball." (m, team)
        m.removed(team, RemovalReason::BallHolding);
    Pushings "pushings" [""] "Robots taken off for pushing." (m, team) m.removed(team, RemovalReason::Pushing);
    GoaliePushings "goalie_pushings" [""] "Robots taken off for pushing a goalkeeper." (m, team)
        m.removed(team, RemovalReason::GoaliePushing);
    Chargings "chargings" [""] "Robots taken off for driving against an opponent." (m, team)
        m.removed(team, RemovalReason::Charging);
    Leavings "leavings" [""] "Robots taken off for leaving the field." (m, team)
        m.removed(team, RemovalReason::LeftTheField);
    Stuck "stuck" [""] "Robots taken off beside a ball that was stuck." (m, team)
        m.removed(team, RemovalReason::LocalStuck);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_unlike_and_named_as_their_metrics() {
        let columns: std::collections::BTreeSet<_> =
            Metric::ALL.iter().map(|metric| metric.column()).collect();
        assert_eq!(columns.len(), Metric::ALL.len());
        for metric in Metric::ALL {
            let words = metric.column().replace('_', "");
            assert_eq!(format!("{metric:?}").to_lowercase(), words);
            assert!(metric.says().ends_with('.'), "{metric:?}");
        }
    }
}
