//! Asking why things stand as they do: the answer is worked out in worlds of its own while the match stands or goes on.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use bevy::prelude::*;

use crate::app::view::state::{Action, FileError, FrameSystems, MatchBegun, Session};
use crate::clock::Clock;
use crate::lab::rewind::{MatchEventKind, Rewind};
use crate::lab::why::{Candidate, WhyChoice, WhyPlan, WhyReport};
use crate::world::referee::Decision;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<AskedWhy>()
        .add_message::<Action>()
        .add_observer(|_: On<MatchBegun>, mut commands: Commands| {
            commands.insert_resource(AskedWhy::default());
        })
        .add_systems(Update, (ask.run_if(is_wanted), hear).chain().in_set(FrameSystems::Input));
}

/// What a person has asked, and the answer.
#[derive(Resource, Default)]
pub struct AskedWhy {
    /// The question that is worked on.
    pub question: Option<Arc<WhyQuestion>>,
    /// The last answer.
    pub report: Option<WhyReport>,
}

/// A question that is worked on by another thread. It ends early when nobody wants to know any more.
pub struct WhyQuestion {
    /// The tick that it is about.
    pub tick: u64,
    tried: AtomicU32,
    all: AtomicU32,
    is_dropped: AtomicBool,
    answer: Mutex<Option<WhyReport>>,
}

impl WhyQuestion {
    /// How many changes were tried, and how many there are; none before it is known.
    pub fn progress(&self) -> (u32, u32) {
        (self.tried.load(Ordering::Relaxed), self.all.load(Ordering::Relaxed))
    }
}

impl AskedWhy {
    /// What was changed in a finding of the last answer.
    pub fn reason(&self, place: usize) -> Option<Candidate> {
        Some(self.report.as_ref()?.findings.get(place)?.candidate.clone())
    }

    /// Whether there is a question or an answer.
    pub fn is_open(&self) -> bool {
        self.question.is_some() || self.report.is_some()
    }

    /// Nobody wants to know any more.
    pub fn close(&mut self) {
        if let Some(question) = self.question.take() {
            question.is_dropped.store(true, Ordering::Relaxed);
        }
        self.report = None;
    }
}

impl Drop for AskedWhy {
    fn drop(&mut self) {
        self.close();
    }
}

/// What is asked in a window.
const CHOICE: WhyChoice = WhyChoice { at: None, horizon: 20.0, seeds: 4, most: 300 };
/// A goal so soon after the present moment is what is meant, s: a click on a goal goes to just before it.
const SOON: f32 = 0.5;

fn is_wanted(mut actions: MessageReader<Action>) -> bool {
    actions.read().filter(|action| **action == Action::Why).count() > 0
}

fn ask(
    (session, clock): (Res<Session>, Res<Clock>),
    rewind: Option<Res<Rewind>>,
    mut asked: ResMut<AskedWhy>,
    mut file_error: ResMut<FileError>,
) {
    let (Some(rewind), Some(header)) = (rewind, &session.header) else { return };
    asked.close();
    let tick = meant(&rewind, &clock);
    let plan = match WhyPlan::of(header, rewind.requests(), tick, CHOICE) {
        Ok(plan) => plan,
        Err(error) => return file_error.0 = Some(error.to_string()),
    };
    let question = Arc::new(WhyQuestion {
        tick,
        tried: AtomicU32::new(0),
        all: AtomicU32::new(0),
        is_dropped: AtomicBool::new(false),
        answer: Mutex::new(None),
    });
    asked.question = Some(question.clone());
    std::thread::spawn(move || {
        let begins = |count: usize| question.all.store(count as u32, Ordering::Relaxed);
        let report = plan.run(begins, |tried| {
            question.tried.store(tried, Ordering::Relaxed);
            !question.is_dropped.load(Ordering::Relaxed)
        });
        *question.answer.lock().unwrap_or_else(PoisonError::into_inner) = Some(report);
    });
}

/// With other dice the same goal may fall so much later, s.
const LATER: f32 = 1.0;

/// The tick after which things stand as is asked: a moment after a goal at the present moment, or else the last one.
fn meant(rewind: &Rewind, clock: &Clock) -> u64 {
    let soon = clock.tick..clock.tick + clock.ticks(SOON);
    let is_goal = |what: &MatchEventKind| matches!(what, MatchEventKind::Call(Decision::Goal { .. }));
    let mut events = rewind.events(rewind.present());
    let goal = events.find(|event| soon.contains(&event.tick) && is_goal(&event.what));
    goal.map_or(clock.tick.saturating_sub(1), |goal| goal.tick + clock.ticks(LATER))
}

fn hear(mut asked: ResMut<AskedWhy>) {
    let Some(question) = &asked.question else { return };
    let answer = question.answer.lock().unwrap_or_else(PoisonError::into_inner).take();
    if answer.is_some() {
        asked.report = answer;
        asked.question = None;
    }
}
