//! The result of `touchline run`: what a match has come to, for people and as JSON.

use std::io::{self, Write};

use serde::Serialize;

use super::box_report::BoxReport;
use super::broken_report::BrokenReport;
use crate::comms::radio::{LinkCounters, RadioRecord};
use crate::comms::tcm::{MessageBudgets, Spent};
use crate::data::in_one_line;
use crate::game::net::chaos::ChaosFigures;
use crate::game::net::{self, CarrierFigures, RemoteFigures, UdpCarrier};
use crate::game::record::{
    AGGLOMERATION, BallOverlap, BookingFigures, CROWD, ContactTotal, GripFigures, HoldFigures, KickFigures,
    LooseBalls, Pursuit, Removals, RobotContacts, RoleCover,
};
use crate::game::{Match, MatchPlan};
use crate::ids::Team;

/// The result of a match, home first where there are two figures.
#[derive(Debug, Serialize)]
pub(super) struct RunReport {
    name: String,
    teams: [String; 2],
    seed: u64,
    score: [u32; 2],
    /// Shares of the time in which either team had the ball.
    possession: [f64; 2],
    /// Share of play with two or more team mates within a metre of the ball.
    crowding: [f64; 2],
    /// Share of play with two or more team mates within half a metre of the ball.
    agglomeration: [f64; 2],
    /// Shares of play with two or more team mates near the ball, at several distances.
    crowded: Vec<Crowded>,
    /// Who drove at the ball, by what robots do.
    pursuit: [Pursuit; 2],
    /// How well each team's ball booking met its requirements, by what its robots believe.
    booking_beliefs: [BookingFigures; 2],
    /// Who touched whom.
    contacts: ContactReport,
    /// Balls that nobody touched, and who won them.
    loose_balls: LooseBalls,
    /// Kicks that were tried, struck and missed.
    kicks: [KickFigures; 2],
    /// Balls that chins caught and lost.
    grips: [GripFigures; 2],
    /// How often robots fell.
    falls: [u32; 2],
    /// Whom the referee took off, by reason.
    removals: Removals,
    /// How long robots kept their roles.
    roles: [HoldFigures<usize>; 2],
    /// For how long roles had nobody, or more robots than they should.
    role_cover: [RoleCover; 2],
    /// How long robots kept the states of their machines.
    states: [HoldFigures<(usize, usize)>; 2],
    /// How deep the ball has sunk into robots and walls.
    overlap: BallOverlap,
    /// What should hold of every match and did not.
    invariants: BrokenReport,
    /// Metres, all robots of a team together.
    driven: [f64; 2],
    /// What a team's robots said to each other.
    messages: [Messages; 2],
    /// What the teams said as the league counts it, where the match is announced or keeps to the league's limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    budgets: Option<[TeamBudget; 2]>,
    /// Counts of the datagrams that crossed a network.
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<Network>,
    /// Counts of what has passed between the match and ChaosManager.
    #[serde(skip_serializing_if = "Option::is_none")]
    chaos: Option<ChaosFigures>,
    /// What was heard of the referee box that refereed it.
    #[serde(skip_serializing_if = "Option::is_none")]
    referee_box: Option<BoxReport>,
    /// Simulated seconds.
    seconds: f64,
    ticks: u64,
    /// Depends on the machine.
    ticks_per_second: f64,
    /// Equal digests mean equal matches.
    digest: String,
    /// Whether it is the result so far of a match that did not come to its end.
    pub interrupted: bool,
}

/// A share of play with two or more team mates within some metres of the ball.
#[derive(Debug, Serialize)]
struct Crowded {
    within: f32,
    share: [f64; 2],
}

/// Contacts between robots: of each team's own robots with each other, and of those of different teams.
#[derive(Debug, Serialize)]
struct ContactReport {
    mates: [ContactTotal; 2],
    opponents: ContactTotal,
}

impl ContactReport {
    fn of(contacts: &RobotContacts) -> ContactReport {
        let mates = Team::BOTH.map(|team| contacts.of_mates(team));
        ContactReport { mates, opponents: contacts.of_opponents() }
    }
}

/// A team's messages, each datagram once however many robots hear it.
#[derive(Debug, Serialize)]
struct TeamBudget {
    #[serde(flatten)]
    spent: Spent,
    left: u64,
}

impl TeamBudget {
    fn of(game: &Match) -> Option<[TeamBudget; 2]> {
        let budgets = game.world().get_resource::<MessageBudgets>()?;
        Some(Team::BOTH.map(|team| TeamBudget { spent: budgets.spent(team), left: budgets.left(team) }))
    }
}

/// What crossed a network: the datagrams of the robots that this process ran, and how the others answered.
#[derive(Debug, Serialize)]
struct Network {
    here: CarrierFigures,
    elsewhere: Vec<RemoteFigures>,
}

impl Network {
    fn of(game: &Match) -> Option<Network> {
        let carrier = game.world().get_resource::<UdpCarrier>()?;
        Some(Network { here: carrier.figures, elsewhere: net::remote_figures(game.world()) })
    }

    fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let here = self.here;
        writeln!(
            out,
            "datagrams   {:6} sent and {} received by the robots of this process",
            here.sent, here.received
        )?;
        writeln!(
            out,
            "            {:6} from computers, {} from nobody we know, {} not sent",
            here.from_computers, here.foreign, here.refused
        )?;
        for robot in &self.elsewhere {
            writeln!(
                out,
                "{:11} {:6} ticks told, {} answered; {} datagrams sent and {} received",
                robot.robot.to_string(),
                robot.told,
                robot.answered,
                robot.sent,
                robot.received
            )?;
        }
        Ok(())
    }
}

/// The packets of a team: a message to three team mates is three.
#[derive(Debug, Serialize)]
struct Messages {
    sent: u64,
    delivered: u64,
    lost: u64,
    late: u64,
    bytes: u64,
}

impl Messages {
    fn of(team: Team, radio: &RadioRecord) -> Messages {
        let all = radio.sum(|from, _, _| from.team == team);
        let LinkCounters { sent, delivered, late, bytes, .. } = all;
        Messages { sent, delivered, lost: all.lost_in_all(), late, bytes }
    }
}

impl RunReport {
    pub fn of(game: &Match, plan: &MatchPlan, wall_seconds: f64) -> RunReport {
        let (record, clock) = (game.record(), game.clock());
        let shares = |seconds: [f64; 2]| seconds.map(|seconds| share(seconds, record.played));
        let crowded = record.crowding.by_radius().into_iter();
        let crowded = crowded.map(|(within, seconds)| Crowded { within, share: shares(seconds) });
        RunReport {
            name: plan.name.clone(),
            teams: plan.teams.each_ref().map(|team| team.strategy.name.clone()),
            seed: plan.seed,
            score: game.state().score,
            possession: record.possession_shares(),
            crowding: shares(record.crowding.seconds(CROWD)),
            agglomeration: shares(record.crowding.seconds(AGGLOMERATION)),
            crowded: crowded.collect(),
            pursuit: record.pursuit.clone(),
            booking_beliefs: record.bookings.clone(),
            contacts: ContactReport::of(&record.contacts),
            loose_balls: record.loose_balls,
            kicks: record.kicks,
            grips: record.grips,
            falls: record.falls,
            removals: record.removals.clone(),
            roles: record.roles.clone(),
            role_cover: record.role_cover,
            states: record.states.clone(),
            overlap: record.overlap,
            invariants: BrokenReport::of(game),
            driven: Team::BOTH.map(|team| record.driven_by(team)),
            messages: Team::BOTH.map(|team| Messages::of(team, game.world().resource::<RadioRecord>())),
            budgets: TeamBudget::of(game),
            network: Network::of(game),
            chaos: net::chaos_figures(game.world()),
            referee_box: BoxReport::of(game),
            seconds: clock.now(),
            ticks: clock.tick,
            ticks_per_second: share(clock.tick as f64, wall_seconds),
            digest: format!("{:016x}", record.digest),
            interrupted: !game.is_over(),
        }
    }

    pub fn print(&self, out: &mut impl Write) -> io::Result<()> {
        if self.interrupted {
            writeln!(out, "interrupted after {:.0} s; the result so far:", self.seconds)?;
        }
        let [home, away] = self.teams.each_ref().map(|name| in_one_line(name));
        writeln!(out, "{home} {} : {} {away}", self.score[0], self.score[1])?;
        let percent = |[home, away]: [f64; 2]| format!("{:4.0} % : {:.0} %", 100.0 * home, 100.0 * away);
        writeln!(out, "possession  {}", percent(self.possession))?;
        writeln!(out, "crowding    {}", percent(self.crowding))?;
        writeln!(out, "driven      {:4.0} m : {:.0} m", self.driven[0], self.driven[1])?;
        let [home, away] = &self.messages;
        writeln!(out, "messages    {:6} : {} ({} and {} lost)", home.sent, away.sent, home.lost, away.lost)?;
        if let Some([home, away]) = &self.budgets {
            writeln!(out, "budget      {:6} : {} messages left of the league's", home.left, away.left)?;
            let held_back = [home, away].map(|team| team.spent.over_budget);
            if held_back.iter().any(|messages| *messages > 0) {
                writeln!(
                    out,
                    "            {:6} : {} not sent, to keep within it",
                    held_back[0], held_back[1]
                )?;
            }
        }
        if let Some(network) = &self.network {
            network.print(out)?;
        }
        if let Some(chaos) = &self.chaos {
            print_chaos(chaos, out)?;
        }
        if let Some(referee_box) = &self.referee_box {
            referee_box.print(out)?;
        }
        self.invariants.print(out)?;
        let pace = share(self.ticks_per_second * self.seconds, self.ticks as f64);
        writeln!(
            out,
            "{:.0} s in {} ticks, {:.0} ticks/s, {pace:.0} times real time",
            self.seconds, self.ticks, self.ticks_per_second
        )?;
        writeln!(out, "seed {}, digest {}", self.seed, self.digest)
    }
}

fn print_chaos(chaos: &ChaosFigures, out: &mut impl Write) -> io::Result<()> {
    let (images, data, orders) = (chaos.images, chaos.data, chaos.orders);
    writeln!(
        out,
        "ChaosManager {:5} pictures and {} data sent, {} dropped, {} bytes",
        images.sent,
        data.sent,
        images.dropped + data.dropped,
        images.bytes + data.bytes
    )?;
    writeln!(
        out,
        "            {:6} orders obeyed, {} refused; {} datagrams from elsewhere, {} that say nothing",
        orders.obeyed, orders.refused, orders.foreign, orders.malformed
    )
}

/// A part of a whole; nothing of nothing is 0, since JSON has no other number for it.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::data::AssetFolder;

    fn numbers(value: &Value) -> Vec<f64> {
        match value {
            Value::Number(number) => number.as_f64().into_iter().collect(),
            Value::Null => vec![f64::NAN],
            Value::Array(items) => items.iter().flat_map(numbers).collect(),
            Value::Object(fields) => fields.values().flat_map(numbers).collect(),
            Value::Bool(_) | Value::String(_) => Vec::new(),
        }
    }

    #[test]
    fn the_result_of_a_match_that_never_began_has_a_number_in_each_place() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plan = MatchPlan::read(&assets, &crate::game::Choice::default()).expect("the default match");
        let report = RunReport::of(&Match::new(&plan), &plan, 0.0);
        assert!(report.interrupted);
        let numbers = numbers(&serde_json::to_value(&report).expect("the report is JSON"));
        assert!(numbers.len() > 20 && numbers.iter().all(|number| number.is_finite()), "{numbers:?}");
        let mut text = Vec::new();
        report.print(&mut text).expect("memory takes everything");
        let text = String::from_utf8_lossy(&text);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}
