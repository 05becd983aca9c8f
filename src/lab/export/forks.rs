//! What would have become of a match: one thing in it happens otherwise, and it is played on.

use super::moment::MatchWatch;
use super::page::{ForkRecorder, PageFork, PageRecorder};
use crate::comms::radio::{FaultRule, Transmission, TransmissionState};
use crate::comms::tcm::DataType;
use crate::game::requests::{RadioChange, Request, Script};
use crate::game::{Match, MatchPlan};
use crate::state::Snapshot;

/// Other futures of a match.
#[derive(Clone, Debug, PartialEq)]
pub enum PageForks {
    /// So many at most: shortly before each goal a message is lost that arrived.
    BeforeGoals(usize),
    /// These, in this order.
    Given(Vec<ForkPlan>),
}

/// One thing that happens otherwise, and for how long the match is played on.
#[derive(Clone, Debug, PartialEq)]
pub struct ForkPlan {
    /// What is changed, in words.
    pub title: String,
    /// What is known to come of it, in words.
    pub finding: Option<String>,
    /// The tick in which it is changed; the match before it is the same.
    pub from: u64,
    /// The last tick that is played.
    pub until: u64,
    /// The requests of the whole match with the change.
    pub script: Vec<(u64, Request)>,
}

/// The most forks that a page has.
pub const MOST_FORKS: usize = 12;
/// Messages that led to a goal are looked for so long before it, and a fork goes on for so long after it, s.
const BEFORE: f64 = 20.0;
const AFTER: f64 = 8.0;

/// Messages that a team arranges things with; each of them, lost, may change what happens.
const DECISIVE: [DataType; 6] = [
    DataType::LOCK,
    DataType::ACK_LOCK,
    DataType::SWAP,
    DataType::ACK_SWAP,
    DataType::BOOK,
    DataType::HAVE_BALL,
];

/// For each goal, the last messages before it that arrived: as many for each as there are to be in all. Of messages that were said
/// again and again the newest counts. Each is lost in a future of its own, besides what the script of the match asks for.
pub fn lost_before_goals(
    page: &PageRecorder,
    script: &[(u64, Request)],
    dt: f64,
    most: usize,
) -> Vec<ForkPlan> {
    let goals: Vec<u64> = page.goals().collect();
    let each = (most / goals.len().max(1)).clamp(1, 4);
    let plans = goals.iter().rev().flat_map(|goal| {
        let earliest = goal.saturating_sub((BEFORE / dt) as u64);
        let led = page.told_messages().iter().filter(|entry| (earliest..*goal).contains(&entry.sent));
        let led = led.filter(|entry| {
            DECISIVE.contains(&entry.packet.kind) && matches!(entry.state, TransmissionState::Arrived(_))
        });
        let mut led: Vec<&Transmission> = led.collect();
        led.sort_unstable_by_key(|entry| std::cmp::Reverse(entry.id));
        let mut seen = Vec::new();
        led.retain(|entry| {
            let what = (entry.packet.kind, entry.packet.from);
            let is_new = !seen.contains(&what);
            seen.push(what);
            is_new
        });
        led.truncate(each);
        led.into_iter().map(|entry| lost(entry, script, *goal, dt)).collect::<Vec<_>>()
    });
    let mut plans: Vec<ForkPlan> = plans.take(most).collect();
    plans.sort_by_key(|fork| fork.from);
    plans
}

/// The message is lost on its way to all whom it was sent to in that tick.
fn lost(entry: &Transmission, script: &[(u64, Request)], goal: u64, dt: f64) -> ForkPlan {
    let (kind, from) = (entry.packet.kind, entry.packet.from);
    let rule = FaultRule::silencing(kind, from, entry.sent..entry.sent + 1, dt as f32);
    let change = (entry.sent, Request::Radio(RadioChange::Fault(rule)));
    ForkPlan {
        title: format!("{kind} from {from} is lost"),
        finding: None,
        from: entry.sent,
        until: goal + (AFTER / dt) as u64,
        script: script.iter().cloned().chain([change]).collect(),
    }
}

/// Plays the match again, and each fork from its tick on, in the order of their beginnings; none if it is to stop. They are handed
/// over in the order in which they were given. `score_at` tells how the match itself stood at a tick.
pub fn play_forks(
    plan: &MatchPlan,
    forks: &[ForkPlan],
    score_at: impl Fn(u64) -> [u32; 2],
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Vec<PageFork>> {
    if forks.is_empty() {
        return Some(Vec::new());
    }
    let (mut game, mut other) = (Match::new(plan), Match::new(plan));
    let mut by_beginning: Vec<(usize, &ForkPlan)> = forks.iter().enumerate().collect();
    by_beginning.sort_by_key(|(_, fork)| fork.from);
    let mut played = Vec::new();
    for (place, fork) in by_beginning {
        while game.clock().tick < fork.from {
            if game.clock().tick.is_multiple_of(ASK_EVERY) && !goes_on() {
                return None;
            }
            game.tick();
        }
        if !goes_on() {
            return None;
        }
        // Both were started from one plan, so that the snapshot fits.
        if Snapshot::take(game.world_mut()).restore(other.world_mut()).is_ok() {
            played.push((place, play_fork(&mut other, fork, &score_at)));
        }
    }
    played.sort_by_key(|(place, _)| *place);
    Some(played.into_iter().map(|(_, fork)| fork).collect())
}

/// So many of them, those first that end with another score than the match has then; in the order of their beginnings.
pub fn most_telling(
    mut forks: Vec<PageFork>,
    most: usize,
    score_at: impl Fn(u64) -> [u32; 2],
) -> Vec<PageFork> {
    forks.sort_by_key(|fork| fork.ends_with(score_at(fork.ends_at())));
    forks.truncate(most);
    forks.sort_by_key(PageFork::begins_at);
    forks
}

/// Ticks between two questions whether to go on.
const ASK_EVERY: u64 = 600;

fn play_fork(game: &mut Match, fork: &ForkPlan, score_at: impl Fn(u64) -> [u32; 2]) -> PageFork {
    let mut watch = MatchWatch::new(game.world_mut());
    let mut recorder = ForkRecorder::new(fork.title.clone());
    recorder.observe(&watch.look(game.world()));
    let script: Vec<_> = fork.script.iter().filter(|(tick, _)| *tick >= fork.from).cloned().collect();
    game.world_mut().insert_resource(Script::new(&script));
    while game.clock().tick < fork.until && !game.is_over() {
        game.tick();
        recorder.observe(&watch.look(game.world()));
    }
    recorder.finish(|until, [home, away]| {
        let [was_home, was_away] = score_at(until);
        let changed = if [home, away] == [was_home, was_away] { "as" } else { "not as" };
        let finding = fork.finding.as_ref().map_or_else(String::new, |finding| format!("{finding}; "));
        format!("{finding}{home}:{away} at its end, {changed} in the match ({was_home}:{was_away})")
    })
}
