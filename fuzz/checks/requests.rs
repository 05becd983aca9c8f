//! What must hold of a match whatever is asked of it.

use touchline::game::record::{Invariant, Invariants};
use touchline::game::requests::Request;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::geometry::{Pose, Twist};
use touchline::ids::RobotId;

use super::shipped::shipped;

/// How long a match goes on after the last thing was asked of it, ticks.
const AFTER: u64 = 20;

/// Whatever is asked of a match, everything in it stays a number and in the world. The input is requests, each behind the number of
/// ticks to the one before.
pub fn requests(input: &[u8]) {
    let choice = Choice { home: Some("hammerheads_swap".into()), seed: 1, ..Choice::default() };
    let mut plan = MatchPlan::read(&shipped(), &choice).expect("the shipped match is sound");
    let (mut rest, mut tick) = (input, 0);
    while let Some((wait, tail)) = rest.split_first() {
        let Ok((request, behind)) = postcard::take_from_bytes::<Request>(tail) else { break };
        (rest, tick) = (behind, tick + u64::from(wait % 16));
        plan.script.push((tick, request));
    }
    if plan.script.is_empty() || plan.script.len() > 50 {
        return;
    }
    let mut game = Match::new(&plan);
    for _ in 0..tick + AFTER {
        game.tick();
    }
    let world = game.world_mut();
    let mut bodies = world.query::<(Option<&RobotId>, &Pose, &Twist)>();
    for (robot, pose, twist) in bodies.iter(world) {
        assert!(pose.is_finite() && twist.is_finite(), "{robot:?}: {pose:?}, {twist:?}");
    }
    let broken = &world.resource::<Invariants>().broken;
    let never = [Invariant::Finite, Invariant::InTheWorld, Invariant::RolesAreKept];
    assert!(broken.keys().all(|(invariant, _)| !never.contains(invariant)), "{broken:?}");
}
