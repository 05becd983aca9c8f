//! Time: a match begins, the ticks that are due in a frame run, and what they bring is noted. Nothing that affects a match runs
//! anywhere else in the window.

pub mod announcements;
pub mod asking;
mod begin;
mod beside;
pub mod expectations;
pub mod recording;
mod reload;
pub mod remote_robots;
mod rewinding;

use std::time::{Duration, Instant};

use bevy::prelude::*;
use remote_robots::is_waiting;

use super::state::{AfterTick, FileError, FrameSystems, OpenDialogues, Playback, StopReason};
use crate::clock::Clock;
use crate::game::net;
use crate::lab::rewind::Rewind;
use crate::world::gamecontroller::BoxNews;
use crate::world::referee::{MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((
        asking::plugin,
        begin::plugin,
        recording::plugin,
        reload::plugin,
        expectations::plugin,
        announcements::plugin,
        remote_robots::plugin,
        beside::plugin,
        rewinding::plugin,
    ))
    .add_systems(
        Update,
        (
            rewinding::go,
            pass_time,
            rewinding::take_seat_again,
            (beside::show_what_was_left, beside::play_beside).chain(),
            announce,
        )
            .chain()
            .in_set(FrameSystems::Time),
    );
}

/// The time in one frame after which no further tick is begun: at 64 times on a slow machine the window stays responsive.
const FRAME_BUDGET: Duration = Duration::from_millis(25);

/// The time in one frame that its ticks wait for robots in other processes.
const ROBOTS_BUDGET: Duration = Duration::from_millis(20);

fn pass_time(world: &mut World) {
    if world.resource::<OpenDialogues>().question.is_some() || is_over(world) || is_waiting(world) {
        return;
    }
    let elapsed = world.resource::<Time<Real>>().delta_secs();
    let dt = world.resource::<Clock>().dt;
    let refereed = world.contains_resource::<BoxNews>();
    let mut playback = world.resource_mut::<Playback>();
    // A referee box has the clock of the room, at any speed.
    let elapsed = if refereed { elapsed / playback.factor() } else { elapsed };
    let due = playback.take_ticks(elapsed, dt);
    net::grant(world, ROBOTS_BUDGET);
    let began = Instant::now();
    world.resource_scope(|world, mut rewind: Mut<Rewind>| {
        for _ in 0..due {
            rewind.play(world, |world| world.run_schedule(AfterTick));
            recording::follow(world, &rewind);
            let stopped = world.resource::<StopReason>().0.is_some();
            if began.elapsed() > FRAME_BUDGET || stopped || is_over(world) {
                break;
            }
        }
    });
}

/// The match is announced while it stands still, too.
fn announce(world: &mut World) {
    let elapsed = world.resource::<Time<Real>>().delta_secs();
    if let Some(file_error) = net::announce_in_real_time(world, elapsed) {
        world.resource_mut::<FileError>().0 = Some(file_error);
    }
}

fn is_over(world: &World) -> bool {
    world.get_resource::<MatchState>().is_none_or(|state| state.phase == Phase::Finished)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::match_request::MatchRequest;
    use crate::app::view::picture::visuals::BodyVisual;
    use crate::app::view::played_without_a_window;
    use crate::app::view::state::PendingMatch;
    use crate::data::AssetFolder;
    use crate::game::record::Record;
    use crate::game::{Choice, Match, MatchPlan};

    fn assets() -> AssetFolder {
        AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
    }

    #[test]
    fn the_window_plays_the_same_match_as_the_headless_runner_whatever_the_frame_rate() {
        let choice = Choice { half_minutes: Some(0.1), seed: 3, ..Choice::default() };
        let plan = MatchPlan::read(&assets(), &choice).expect("the default match");
        let mut headless = Match::new(&plan);
        while !headless.is_over() {
            headless.tick();
        }
        for (milliseconds, speed) in [(7, 3), (50, 6)] {
            let mut app = played_without_a_window(&choice, Duration::from_millis(milliseconds));
            app.world_mut().resource_mut::<Playback>().speed = speed;
            for _ in 0..20_000 {
                app.update();
                if is_over(app.world()) {
                    break;
                }
            }
            assert_eq!(app.world().resource::<Clock>().tick, headless.clock().tick);
            assert_eq!(app.world().resource::<Record>().digest, headless.record().digest);
        }
    }

    #[test]
    fn four_legged_robots_are_drawn_and_watched_without_a_change() {
        let choice = Choice {
            file: Some("four_legged_2005".into()),
            seed: 5,
            half_minutes: Some(0.05),
            ..Choice::default()
        };
        let plan = MatchPlan::read(&assets(), &choice).expect("the four-legged match");
        let mut headless = Match::new(&plan);
        let mut app = played_without_a_window(&choice, Duration::from_millis(50));
        for _ in 0..60 {
            app.update();
        }
        while headless.clock().tick < app.world().resource::<Clock>().tick {
            headless.tick();
        }
        assert_eq!(app.world().resource::<Record>().digest, headless.record().digest);
        let shown = app.world_mut().query::<&BodyVisual>().iter(app.world()).count();
        assert_eq!(shown, 8 + 1, "robots and the ball");
    }

    #[test]
    fn a_match_is_announced_twice_a_second_on_the_wall_at_any_speed_paused_and_over() {
        let ears = std::net::UdpSocket::bind("127.0.0.1:0").expect("there is a free port");
        ears.set_nonblocking(true).expect("sockets can do that");
        let network = net::NetworkPlan { announce: ears.local_addr().ok(), ..Default::default() };
        let network = Box::new(network);
        let choice = Choice { half_minutes: Some(0.5), seed: 3, network, ..Choice::default() };
        let mut app = played_without_a_window(&choice, Duration::from_millis(100));
        let heard = |app: &mut App, frames| {
            (0..frames).for_each(|_| app.update());
            std::iter::from_fn(|| ears.recv(&mut [0; 300]).ok()).count()
        };
        heard(&mut app, 1);
        for (speed, paused) in [(3, false), (0, false), (3, true)] {
            (
                app.world_mut().resource_mut::<Playback>().speed,
                app.world_mut().resource_mut::<Playback>().paused,
            ) = (speed, paused);
            let (before, count) = (app.world().resource::<Clock>().tick, heard(&mut app, 50));
            assert!((9..=11).contains(&count), "{count} packets in five seconds at speed {speed}");
            assert_eq!(app.world().resource::<Clock>().tick == before, paused);
        }
        let playback = &mut app.world_mut().resource_mut::<Playback>();
        (playback.speed, playback.paused) = (9, false);
        while !is_over(app.world()) {
            heard(&mut app, 1);
        }
        let count = heard(&mut app, 50);
        assert!((9..=11).contains(&count), "{count} packets in five seconds after the end");
    }

    #[test]
    fn a_match_is_drawn_once_and_cleared_away_for_the_next() {
        let choice = Choice { seed: 3, ..Choice::default() };
        let mut app = played_without_a_window(&choice, Duration::from_millis(16));
        let count = |app: &mut App| app.world_mut().query::<&BodyVisual>().iter(app.world()).count();
        app.update();
        let first = count(&mut app);
        assert_eq!(first, 8 + 8 + 1, "drive units, trailers and the ball");
        app.world_mut().resource_mut::<PendingMatch>().0 = Some(MatchRequest::Match(choice));
        app.update();
        assert_eq!(count(&mut app), first);
    }
}
