use super::*;
use crate::game::net::chaos::messages::StrategyText;
use crate::game::net::chaos::outbox::Outbox;
use crate::ids::Team;
use crate::rng::{Dice, Seed};
use crate::vision::{Gaze, Image, Yuv};

const ROBOT: RobotId = RobotId::new(Team::Home, 1);

fn at(port: u16) -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], port))
}

fn talk() -> ChaosTalk {
    ChaosTalk::new([at(1), at(2), at(3)], ROBOT, 100)
}

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// A picture that is different from others.
fn image(seed: u8) -> Image {
    let pixels = (0..208 * 160).map(|place| Yuv { y: (place % 251) as u8, u: seed, v: 9 });
    Image { width: 208, height: 160, pixels: pixels.collect() }
}

/// The datagrams of a message of the robot.
fn said<T: Data>(data: &T, counter: u32) -> Vec<Vec<u8>> {
    let message = ExternalMessage::of(data, ROBOT.into(), Peer::Computer(0));
    cut(&message, counter, USUAL_DATAGRAM).unwrap()
}

fn answer(number: u32, outcome: Result<(), Refusal>, counter: u32) -> Vec<u8> {
    said(&OrderAnswer { number, outcome }, counter).remove(0)
}

#[test]
fn a_subscription_is_renewed_and_controls_are_repeated() {
    let mut talk = talk();
    assert!(talk.due(ms(0)).is_empty(), "nothing is wanted");
    talk.subscribe(Subscription { images_hz: 1.0, data_hz: 0.0 });
    let sent = (0..100).filter(|step| !talk.due(ms(10 * step)).is_empty()).count();
    assert_eq!(sent, 2);
    talk.subscribe(Subscription::default());
    talk.steer(Some(Pilot { throttle: 1.0, ..Pilot::default() }), ms(1_000));
    assert_eq!((100..200).map(|step| talk.due(ms(10 * step)).len()).sum::<usize>(), 10);
    talk.steer(None, ms(2_000));
    assert_eq!(
        (200..250).map(|step| talk.due(ms(10 * step)).len()).sum::<usize>(),
        2,
        "until it is answered"
    );
    assert_eq!(talk.overdue(ms(3_000)).len(), 1);
}

#[test]
fn an_order_is_sent_until_it_is_answered_and_then_no_more() {
    let mut talk = talk();
    let text = StrategyText { name: "mine.ron".into(), text: "x".into() };
    let number = talk.order(Instruction::PlayStrategy(text), ms(5_000));
    assert_eq!((talk.due(ms(0)).len(), talk.due(ms(299)).len(), talk.due(ms(300)).len()), (1, 0, 1));
    let accepted = answer(number, Ok(()), 1);
    assert_eq!(talk.take(at(2), &accepted, ms(310)), None, "answers come over another socket");
    assert_eq!(talk.take(at(9), &accepted, ms(310)), None, "from somebody else");
    assert_eq!((talk.figures().foreign, talk.heard()), (2, None));
    assert_eq!(talk.take(at(3), &accepted, ms(310)), Some(ChaosNews::Accepted(number)));
    assert_eq!(talk.take(at(3), &answer(number, Ok(()), 2), ms(311)), None, "it comes twice");
    assert!(talk.due(ms(900)).is_empty() && talk.overdue(ms(9_000)).is_empty());
    assert_eq!(talk.heard(), Some(ms(311)));
}

#[test]
fn an_order_that_nobody_answers_is_reported() {
    let mut talk = talk();
    let number = talk.order(Instruction::Teleoperate(None), ms(1_000));
    assert_eq!(talk.overdue(ms(999)), []);
    assert_eq!(talk.overdue(ms(1_000)), [ChaosNews::Unanswered(number)]);
    assert!(talk.due(ms(1_001)).is_empty());
}

#[test]
fn a_refusal_of_what_is_otherwise_not_answered_is_told() {
    let mut talk = talk();
    let refusal = Refusal { what: "subscription".into(), why: "no pictures".into() };
    let news = talk.take(at(3), &answer(77, Err(refusal.clone()), 1), ms(0));
    assert_eq!(news, Some(ChaosNews::Refused(77, refusal)));
}

#[test]
fn pictures_over_a_link_with_loss_arrive_whole_or_are_counted_as_missing() {
    let mut dice = Dice::new(Seed(1), "link", None);
    let (mut talk, mut outbox) = (talk(), Outbox::new(4, 400, 0));
    let mut whole = 0;
    for number in 1..=200u32 {
        let sent = image(number as u8);
        outbox.put(&ImageData::of(&sent, Gaze::default(), 0, number), ROBOT, (Peer::Computer(0), at(4)));
        outbox.send(&mut |_, datagram| {
            // A picture has 73 datagrams, so every other one loses some.
            if dice.uniform() < 0.01 {
                return true;
            }
            if let Some(news) = talk.take(at(1), datagram, ms(u64::from(number) * 33)) {
                let ChaosNews::Image(data) = news else { panic!("it is a picture") };
                assert_eq!((data.number, data.image() == sent), (number, true));
                whole += 1;
            }
            true
        });
    }
    // The last one, so that all before it are known to be missing.
    said(&ImageData::of(&image(0), Gaze::default(), 0, 201), 900_000).iter().for_each(|datagram| {
        talk.take(at(1), datagram, ms(7_000));
    });
    let figures = talk.figures();
    assert!((50..150).contains(&whole), "{whole}");
    assert_eq!((figures.images.received, figures.images.missing), (whole + 1, 200 - whole));
    assert!(figures.expired > 0, "{figures:?}");
}

#[test]
fn a_strategy_of_100_kb_crosses_a_link_with_loss_by_being_sent_again() {
    let mut dice = Dice::new(Seed(2), "link", None);
    let mut talk = talk();
    let text = StrategyText { name: "mine.ron".into(), text: "strategy ".repeat(11_400) };
    assert!(text.text.len() > 100_000);
    talk.order(Instruction::PlayStrategy(text.clone()), ms(5_000));
    let limits = Limits { messages: 16, bytes: 4 << 20, message_bytes: 1 << 20, timeout: 2_000 };
    let mut there = Assembly::new(limits);
    let arrived = (0..50).find_map(|step| {
        let mut sent = talk.due(ms(100 * step)).into_iter().filter(|_| dice.uniform() >= 0.2);
        sent.find_map(|datagram| there.accept(100 * step, &datagram).unwrap()).map(|message| (step, message))
    });
    let (step, message) = arrived.expect("it arrives");
    assert!(step >= 3, "not at once: {step}");
    let order = ChaosOrder::unserialise(message.data_type, &message.data).expect("it is whole");
    assert_eq!(order.instruction, Instruction::PlayStrategy(text));
}

#[test]
fn numbers_tell_what_is_missing_what_is_late_and_what_begins_again() {
    let (mut figures, mut last) = (StreamFigures::default(), None);
    let numbers = [1, 2, 5, 4, 5, 6, 100, 1, 3];
    let new = numbers.map(|number| figures.count(&mut last, number, 10));
    assert_eq!(new, [true, true, true, false, false, true, true, true, true]);
    assert_eq!(figures, StreamFigures { received: 7, missing: 2 + 93 + 1, bytes: 70 });
}
