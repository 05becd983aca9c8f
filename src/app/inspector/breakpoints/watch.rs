//! Looks at each tick and stops the match where a breakpoint is hit.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;

use super::breakpoint::{MessageEvent, StopAt, WhistleKind};
use super::features::{FeatureWatch, WatchedRobots};
use super::list::Breakpoints;
use super::tick_news::{EnteredState, MessageNews, TakenWay, TickNews, WhistleNews};
use crate::app::view::state::{Playback, StopReason};
use crate::clock::Clock;
use crate::comms::radio::{RadioRecord, Transmission, TransmissionState};
use crate::ids::RobotId;
use crate::strategy::{Activity, StateRef, Strategies};
use crate::world::referee::{Decision, Whistles};

/// What there is to see of a tick.
#[derive(SystemParam)]
pub(super) struct SeenTick<'w, 's> {
    clock: Res<'w, Clock>,
    strategies: Res<'w, Strategies>,
    radio: Res<'w, RadioRecord>,
    whistles: Res<'w, Whistles>,
    robots: Query<'w, 's, (&'static RobotId, &'static Activity)>,
    watched: WatchedRobots<'w, 's>,
}

/// Stops the match after a tick in which a breakpoint was hit.
pub(super) fn stop_at_breakpoints(
    breakpoints: Res<Breakpoints>,
    seen: SeenTick,
    mut features: Local<FeatureWatch>,
    mut playback: ResMut<Playback>,
    mut reason: ResMut<StopReason>,
) {
    reason.set_if_neq(StopReason(None));
    let Some(tick) = seen.clock.tick.checked_sub(1).filter(|_| breakpoints.0.iter().any(|it| it.on)) else {
        return;
    };
    let moment = seen.moment(tick, &breakpoints, &mut features);
    let hit = breakpoints.0.iter().find_map(|breakpoint| breakpoint.hit(&moment));
    if let Some(told) = hit {
        *reason = StopReason(Some(told));
        playback.stop(seen.clock.dt);
    }
}

impl SeenTick<'_, '_> {
    fn moment(&self, tick: u64, breakpoints: &Breakpoints, features: &mut FeatureWatch) -> TickNews {
        let on = || breakpoints.0.iter().filter(|breakpoint| breakpoint.on).map(|breakpoint| &breakpoint.at);
        let wanted: Vec<&str> = on()
            .filter_map(|at| match at {
                StopAt::Feature(name) => Some(name.as_str()),
                _ => None,
            })
            .collect();
        let played = Clock { tick, ..*self.clock };
        let mut moment =
            TickNews { features: features.look(&wanted, &self.watched, &played), ..TickNews::default() };
        let mut robots: Vec<_> = self.robots.iter().collect();
        robots.sort_unstable_by_key(|(id, _)| **id);
        for (id, activity) in robots {
            self.note_states(tick, *id, activity, &mut moment);
        }
        if on().any(|at| matches!(at, StopAt::Message { .. })) {
            moment.messages = self.radio.transmissions().flat_map(|sent| news_of(sent, tick)).collect();
        }
        let whistles = self.whistles.heard.iter().rev().take_while(|(heard, _)| *heard == tick);
        moment.whistles = whistles.map(|(_, decision)| whistle(decision)).collect();
        moment.whistles.reverse();
        moment
    }

    fn note_states(&self, tick: u64, robot: RobotId, activity: &Activity, moment: &mut TickNews) {
        let strategy = self.strategies.of(robot.team);
        let index = activity.machine(strategy);
        let machine = &strategy.machines[index];
        let state = StateRef::Plain(activity.state);
        let around = machine.states[activity.state].within.iter().map(|outer| StateRef::Composite(*outer));
        let levels = around.zip(&activity.entered).chain([(state, &activity.since)]);
        let because = activity.taken_in(tick).last().map(|taken| taken.because.clone());
        for (state, _) in levels.filter(|(_, since)| **since == tick) {
            let (machine, state) = (machine.name.clone(), machine.name_of(state).to_owned());
            moment.entered.push(EnteredState { robot, machine, state, because: because.clone() });
        }
        for id in activity.taken_in(tick).filter_map(|taken| taken.transition) {
            let machine = &strategy.machines[id.machine];
            let way = &machine.transitions_of(id.of)[id.number];
            moment.taken.push(TakenWay {
                robot,
                machine: machine.name.clone(),
                from: machine.name_of(id.of).to_owned(),
                go: machine.name_of(machine.target(way)).to_owned(),
                when: way.label.clone(),
            });
        }
    }
}

/// What happened to a message in a tick.
fn news_of(message: &Transmission, tick: u64) -> impl Iterator<Item = MessageNews> {
    let is_sent = message.sent == tick;
    let is_lost = is_sent && matches!(message.state, TransmissionState::Lost(_));
    let is_there = message.state == TransmissionState::Arrived(tick);
    let events =
        [(is_sent, MessageEvent::Sent), (is_lost, MessageEvent::Lost), (is_there, MessageEvent::Arrived)];
    events.into_iter().filter(|(happened, _)| *happened).map(|(_, event)| MessageNews {
        kind: message.packet.kind.to_string(),
        event,
        from: message.packet.from,
        to: message.packet.to,
    })
}

fn whistle(decision: &Decision) -> WhistleNews {
    let robot = match *decision {
        Decision::RobotPlaced { robot, .. }
        | Decision::RobotWarned { robot }
        | Decision::RobotRemoved { robot, .. }
        | Decision::RobotReturned { robot, .. } => Some(robot),
        _ => None,
    };
    WhistleNews { kind: WhistleKind::of(decision), robot, sentence: decision.to_string() }
}
