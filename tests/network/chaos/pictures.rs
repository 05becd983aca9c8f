//! Pictures on the way to ChaosManager, and colours on the way back.

use touchline::game::Choice;
use touchline::vision::{Gaze, Image};
use touchline::world::sense::{ImageEyes, ImageMemory};

use super::*;
use crate::support::assets;

/// AIBOs that see nothing but pictures, against each other.
fn seeing(half_minutes: f32) -> MatchPlan {
    let choice = Choice {
        file: Some("four_legged_images".into()),
        half_minutes: Some(half_minutes),
        seed: 7,
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

#[test]
fn pictures_cross_a_link_with_loss_whole_or_are_counted_as_missing() {
    let (mut game, plan) = open_to(seeing(0.5), &[]);
    let mut manager = Manager::of(&plan, HOME_1, 0.005);
    manager.talk.subscribe(Subscription { images_hz: 10.0, data_hz: 5.0 });
    let mut pictures: Vec<(u64, Gaze, Image)> = Vec::new();
    for _ in 0..240 {
        let news = manager.tick(&mut game);
        let mut robots = game.world_mut().query::<(&RobotId, &ImageEyes, &ImageMemory)>();
        let (_, eyes, memory) =
            robots.iter(game.world()).find(|(id, ..)| **id == HOME_1).expect("it is in the match");
        let last = memory.last().map(|last| (last.tick, last.gaze, eyes.image().clone()));
        let before = pictures.last().map(|(tick, ..)| *tick);
        pictures.extend(last.filter(|(tick, ..)| before != Some(*tick)));
        for news in news {
            let ChaosNews::Image(data) = news else { continue };
            let taken = pictures.iter().find(|(tick, ..)| *tick == data.tick).expect("it was taken");
            assert_eq!((data.gaze, data.image()), (taken.1, taken.2.clone()));
        }
    }
    let (there, sent) = (manager.talk.figures().images, figures(&game).images);
    assert!(there.received > 10 && there.missing > 3, "{there:?}");
    // The last ones may still be under way or be known as missing with the next.
    let known = there.received + there.missing;
    assert!((sent.put_in - 4..=sent.put_in).contains(&known), "{there:?} {sent:?}");
    assert_eq!((sent.dropped, sent.refused), (0, 0));
    assert!(there.bytes > there.received * 208 * 160 * 3, "{there:?}");
}

#[test]
fn more_pictures_than_a_link_takes_are_dropped_the_oldest_first_and_counted() {
    let (mut game, plan) = open_to(seeing(0.5), &[]);
    let robots: Vec<RobotId> = plan.robots().collect();
    let mut managers: Vec<Manager> = robots.iter().map(|robot| Manager::of(&plan, *robot, 0.0)).collect();
    for manager in &mut managers {
        manager.talk.subscribe(Subscription { images_hz: 30.0, data_hz: 0.0 });
    }
    let mut before = 0;
    for _ in 0..90 {
        for manager in &mut managers[1..] {
            manager.say(&game);
        }
        managers[0].tick(&mut game);
        managers[1..].iter_mut().for_each(|manager| drop(manager.hear(&game)));
        let datagrams = figures(&game).images.datagrams;
        assert!(datagrams - before <= 40, "{} datagrams in a tick", datagrams - before);
        before = datagrams;
    }
    let sent = figures(&game).images;
    assert!(sent.dropped > sent.sent, "{sent:?}");
    assert!(sent.put_in - sent.sent - sent.dropped <= 5, "four wait and one leaves: {sent:?}");
    let whole: u64 = managers.iter().map(|manager| manager.talk.figures().images.received).sum();
    assert_eq!(whole, sent.sent);
}

#[test]
fn a_colour_table_that_is_sent_makes_a_robot_blind_and_the_match_replays() {
    let (mut game, plan) = open_to(seeing(0.5), &[]);
    game.world_mut().insert_resource(RequestLog::default());
    let mut manager = Manager::of(&plan, HOME_1, 0.02);
    manager.talk.subscribe(Subscription { images_hz: 0.0, data_hz: 10.0 });
    let hits = |news: &[ChaosNews]| {
        let of = |class| {
            let quality = debug_data(news).into_iter().filter_map(move |data| data.quality);
            quality.map(|quality| quality.class(class).hits).sum::<u64>()
        };
        ColourClass::ALL.map(of).into_iter().sum::<u64>()
    };
    let news = manager.ticks(&mut game, 60);
    assert!(hits(&news) > 0);
    let answer = manager.give(&mut game, Instruction::SetColours(ColourTable::default()));
    assert!(matches!(answer, ChaosNews::Accepted(_)), "{answer:?}");
    manager.ticks(&mut game, 10);
    let news = manager.ticks(&mut game, 60);
    assert_eq!(hits(&news), 0, "what is in no table is never seen");
    let (RequestLog(requests), ticks) = (log_of(&game), game.clock().tick);
    assert_eq!(again(&plan, &requests, ticks).record().digest, game.record().digest);
}
