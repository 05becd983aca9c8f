//! ChaosManager and a match, over links that lose datagrams.

mod pictures;
mod program;

use std::net::{IpAddr, SocketAddr, UdpSocket};
use std::sync::Arc;
use std::time::Duration;

use touchline::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use touchline::comms::tcm::{ExternalMessage, Peer};
use touchline::game::net::chaos::{
    ChaosFigures, ChaosNews, ChaosOrder, ChaosPlan, ChaosTalk, DebugData, Instruction, StrategyText,
    Subscription,
};
use touchline::game::net::{self, NetworkPlan};
use touchline::game::requests::{Request, RequestLog, RobotChange};
use touchline::game::{Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::rng::{Dice, Seed};
use touchline::robot::pilot::Pilot;
use touchline::strategy::Strategies;
use touchline::vision::{
    CameraCalibration, CameraFlaws, CameraSettings, ColourBox, ColourClass, ColourTable, Optics,
};
use touchline::world::referee::Phase;

use super::recorded::{again, log_of};
use super::{HOME_0, HOME_1, open, stranger, talkative};
use crate::support::{digest_of, robot, strategy_text};

/// A match that ChaosManager may speak to from these addresses.
fn open_to(plan: MatchPlan, from: &[IpAddr]) -> (Match, MatchPlan) {
    let at = SocketAddr::from(([127, 0, 0, 1], 1));
    let chaos = Some(ChaosPlan { at, from: from.to_vec() });
    open(&MatchPlan { network: NetworkPlan { chaos, ..NetworkPlan::default() }, ..plan })
}

fn sockets(plan: &MatchPlan) -> [SocketAddr; 3] {
    let chaos = plan.network.chaos.as_ref().expect("ChaosManager may speak to it");
    chaos.addresses().expect("there are three ports")
}

fn figures(game: &Match) -> ChaosFigures {
    net::chaos_figures(game.world()).expect("the sockets are open")
}

/// The time of the match.
fn now(game: &Match) -> Duration {
    Duration::from_secs_f64(game.clock().now())
}

/// A ChaosManager whose datagrams get lost both ways, in match time.
struct Manager {
    talk: ChaosTalk,
    socket: UdpSocket,
    dice: Dice,
    loss: f32,
}

impl Manager {
    fn of(plan: &MatchPlan, robot: RobotId, loss: f32) -> Manager {
        let socket = stranger();
        socket.set_nonblocking(true).expect("sockets can do that");
        let talk = ChaosTalk::new(sockets(plan), robot, 1_000);
        Manager { talk, socket, dice: Dice::new(Seed(5), "chaos link", None), loss }
    }

    fn is_lost(&mut self) -> bool {
        self.dice.uniform() < self.loss
    }

    /// Says what is to be said, plays a tick and hears what comes.
    fn tick(&mut self, game: &mut Match) -> Vec<ChaosNews> {
        self.say(game);
        game.tick();
        self.hear(game)
    }

    /// Says what is to be said.
    fn say(&mut self, game: &Match) {
        for datagram in self.talk.due(now(game)) {
            if !self.is_lost() {
                self.socket.send_to(&datagram, self.talk.orders_to()).expect("it is sent");
            }
        }
    }

    /// What has come by now.
    fn hear(&mut self, game: &Match) -> Vec<ChaosNews> {
        let now = now(game);
        let (mut bytes, mut news) = ([0; 2000], Vec::new());
        while let Ok((length, from)) = self.socket.recv_from(&mut bytes) {
            if !self.is_lost() {
                news.extend(self.talk.take(from, &bytes[..length], now));
            }
        }
        news.extend(self.talk.overdue(now));
        news
    }

    fn ticks(&mut self, game: &mut Match, count: u32) -> Vec<ChaosNews> {
        (0..count).flat_map(|_| self.tick(game)).collect()
    }

    /// Gives an order and plays until it is answered or given up.
    fn give(&mut self, game: &mut Match, instruction: Instruction) -> ChaosNews {
        self.talk.order(instruction, now(game) + Duration::from_secs(10));
        loop {
            let news = self.tick(game);
            let is_answer = |news: &ChaosNews| {
                matches!(news, ChaosNews::Accepted(_) | ChaosNews::Refused(..) | ChaosNews::Unanswered(_))
            };
            if let Some(answer) = news.into_iter().find(is_answer) {
                return answer;
            }
        }
    }
}

/// The text of a shipped strategy under another name, made as long as 100 KB by a comment.
fn long_strategy(name: &str) -> String {
    let (_, text) = strategy_text("hammerheads_2001");
    let named = text.replacen("name: \"", &format!("name: \"{name} "), 1);
    assert_ne!(named, text);
    let padding = "// What a file of a hundred kilobytes says besides.\n".repeat(1_900);
    named + "\n" + &padding
}

fn play(name: &str, text: String) -> Instruction {
    Instruction::PlayStrategy(StrategyText { name: name.into(), text })
}

fn debug_data(news: &[ChaosNews]) -> Vec<&DebugData> {
    let data = news.iter().filter_map(|news| match news {
        ChaosNews::Debug(data) => Some(&**data),
        _ => None,
    });
    data.collect()
}

#[test]
fn a_strategy_of_100_kb_crosses_a_link_with_loss_is_played_and_the_match_replays() {
    let (mut game, plan) = open_to(talkative(1.0), &[]);
    game.world_mut().insert_resource(RequestLog::default());
    let mut manager = Manager::of(&plan, HOME_1, 0.1);
    manager.ticks(&mut game, 30);
    let text = long_strategy("Sent");
    assert!(text.len() > 100_000);
    let answer = manager.give(&mut game, play("mine.ron", text));
    assert!(matches!(answer, ChaosNews::Accepted(_)), "{answer:?}");
    let name = game.world().resource::<Strategies>().of(Team::Home).name.clone();
    assert!(name.starts_with("Sent "), "{name}");
    manager.ticks(&mut game, 300);
    let heard = figures(&game).orders;
    assert_eq!((heard.obeyed, heard.refused), (1, 0), "an order that comes again is the same: {heard:?}");
    let RequestLog(requests) = log_of(&game);
    let changes = requests.iter().filter(|(_, request)| matches!(request, Request::ChangeStrategy { .. }));
    assert_eq!(changes.count(), 1);
    let ticks = game.clock().tick;
    assert_eq!(again(&plan, &requests, ticks).record().digest, game.record().digest);
    assert_ne!(again(&plan, &[], ticks).record().digest, game.record().digest);
}

#[test]
fn a_strategy_with_a_fault_is_refused_with_file_line_and_field_and_changes_nothing() {
    let by_radio = talkative(0.2);
    let (mut game, plan) = open_to(by_radio.clone(), &[]);
    let mut manager = Manager::of(&plan, HOME_1, 0.0);
    let (_, text) = strategy_text("hammerheads_2001");
    let wrong = text.replace("[\"cye\", \"aibo_ers7\"]", "[\"aibo_ers7\"]");
    let elsewhere = "(name: \"x\", based_on: \"../../secret.ron\")";
    for (sent, expected) in [
        (wrong, "mine.ron:12:18: robot_kinds: cannot be played by a `cye`"),
        ("(name: 7)".into(), "mine.ron:1:8: name: "),
        (elsewhere.into(), "mine.ron:1:23: based_on: a strategy that is sent may be based on an asset only"),
    ] {
        let answer = manager.give(&mut game, play("/some/where/mine.ron", sent));
        let ChaosNews::Refused(_, refusal) = answer else { panic!("{answer:?}") };
        assert_eq!(refusal.what, "strategy");
        assert!(refusal.why.starts_with(expected), "{}", refusal.why);
    }
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(game.record().digest, digest_of(&by_radio));
}

#[test]
fn a_robot_tells_what_it_believes_is_in_and_wants_until_nobody_asks_any_more() {
    let by_radio = talkative(0.5);
    let (mut game, plan) = open_to(by_radio.clone(), &[]);
    // The forward, which stands before the ball at the kick-off.
    let mut manager = Manager::of(&plan, RobotId::new(Team::Home, 3), 0.2);
    manager.talk.subscribe(Subscription { images_hz: 0.0, data_hz: 20.0 });
    let news = manager.ticks(&mut game, 600);
    let data = debug_data(&news);
    let strategy = plan.team(Team::Home).strategy.clone();
    let is_of = |name: &String| strategy.roles.iter().any(|role| role.name == *name);
    assert!(data.iter().all(|data| is_of(&data.role) && is_of(&data.acting_as) && !data.states.is_empty()));
    assert!(data.iter().any(|data| data.ball.is_some() && data.is_localised && !data.is_driven));
    let figures = manager.talk.figures().data;
    assert_eq!(figures.received, data.len() as u64);
    let last = data.last().map_or(0, |data| u64::from(data.number));
    assert_eq!(figures.received + figures.missing, last, "every number is there or is missing");
    assert!((150..=200).contains(&last) && figures.missing > 10, "{figures:?}");
    // Nobody renews the subscription from here on.
    (0..400).for_each(|_| game.tick());
    let mut bytes = [0; 2000];
    while manager.socket.recv(&mut bytes).is_ok() {}
    (0..60).for_each(|_| game.tick());
    assert!(manager.socket.recv(&mut bytes).is_err(), "it has ended");
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(game.record().digest, digest_of(&by_radio), "who looks changes nothing");
}

#[test]
fn a_robot_is_driven_stops_when_the_link_breaks_and_goes_back_to_its_strategy() {
    let (mut game, plan) = open_to(talkative(1.0), &[]);
    game.world_mut().insert_resource(RequestLog::default());
    let mut manager = Manager::of(&plan, HOME_1, 0.1);
    manager.talk.subscribe(Subscription { images_hz: 0.0, data_hz: 10.0 });
    while game.state().phase != Phase::Playing {
        manager.tick(&mut game);
    }
    let spin = Pilot { turn: 1.0, ..Pilot::default() };
    manager.talk.steer(Some(spin), now(&game));
    let news = manager.ticks(&mut game, 240);
    assert!(debug_data(&news).iter().any(|data| data.is_driven));
    assert!(robot(&mut game, Team::Home, 1).1.angular.abs() > 0.5, "it turns");
    // Whoever else wants to drive it is refused.
    let mut other = Manager::of(&plan, HOME_1, 0.0);
    other.talk.steer(Some(spin), now(&game));
    let refused = other.ticks(&mut game, 2);
    assert!(matches!(&refused[..], [ChaosNews::Refused(..)]), "{refused:?}");
    // The link breaks.
    (0..90).for_each(|_| game.tick());
    assert!(robot(&mut game, Team::Home, 1).1.angular.abs() < 0.1, "it stands");
    (0..300).for_each(|_| game.tick());
    let RequestLog(requests) = log_of(&game);
    let kinds: Vec<&Request> = requests.iter().map(|(_, request)| request).collect();
    assert_eq!(kinds.first(), Some(&&Request::TakeOver(HOME_1)));
    assert_eq!(kinds.last(), Some(&&Request::HandBack(HOME_1)));
    let stop = Request::Steer { robot: HOME_1, pilot: Pilot::default() };
    assert_eq!(kinds.iter().filter(|request| ***request == stop).count(), 1);
    let ticks = game.clock().tick;
    assert_eq!(again(&plan, &requests, ticks).record().digest, game.record().digest);
    let without: Vec<_> = requests.iter().filter(|(_, request)| *request != stop).cloned().collect();
    assert_ne!(again(&plan, &without, ticks).record().digest, game.record().digest);
}

/// A camera that somebody has calibrated.
fn calibration() -> CameraCalibration {
    let optics = Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };
    let (settings, colours) = (CameraSettings::default(), ColourTable::default());
    CameraCalibration { name: "hall".into(), optics, flaws: CameraFlaws::default(), settings, colours }
}

#[test]
fn a_running_camera_is_set_and_its_colours_are_cut_otherwise() {
    let mut plan = talkative(1.0);
    plan.teams[0].senses.calibration = Some(Arc::new(calibration()));
    let (mut game, plan) = open_to(plan, &[]);
    game.world_mut().insert_resource(RequestLog::default());
    let mut manager = Manager::of(&plan, HOME_1, 0.1);
    manager.talk.subscribe(Subscription { images_hz: 0.0, data_hz: 10.0 });
    let orange = ColourBox { y: (80, 200), u: (40, 110), v: (160, 230) };
    let colours = ColourTable([(ColourClass::Orange, orange)].into());
    let settings = CameraSettings { exposure: 2.0, ..CameraSettings::default() };
    for order in [Instruction::SetCamera(settings), Instruction::SetColours(colours.clone())] {
        let answer = manager.give(&mut game, order);
        assert!(matches!(answer, ChaosNews::Accepted(_)), "{answer:?}");
    }
    let news = manager.ticks(&mut game, 200);
    let last = news.iter().rev().find_map(|news| match news {
        ChaosNews::Camera(data) => Some(&data.calibration),
        _ => None,
    });
    let expected = CameraCalibration { settings, colours: colours.clone(), ..calibration() };
    assert_eq!(last, Some(&expected));
    let asked: Vec<Request> = log_of(&game).0.into_iter().map(|(_, request)| request).collect();
    let changes = [RobotChange::SetCamera(settings), RobotChange::SetColours(colours)];
    assert_eq!(asked, changes.map(|change| Request::Robot(HOME_1, change)));

    let dark = CameraSettings { exposure: 0.0, ..settings };
    let answer = manager.give(&mut game, Instruction::SetCamera(dark));
    let ChaosNews::Refused(_, refusal) = answer else { panic!("{answer:?}") };
    assert!(refusal.why.starts_with("exposure: "), "{refusal:?}");
    // The away team sees by no pictures.
    let mut other = Manager::of(&plan, RobotId::new(Team::Away, 0), 0.0);
    let answer = other.give(&mut game, Instruction::SetCamera(settings));
    assert!(
        matches!(&answer, ChaosNews::Refused(_, refusal) if refusal.why.contains("pictures")),
        "{answer:?}"
    );
}

#[test]
fn orders_from_an_address_that_the_match_does_not_list_do_nothing() {
    let by_radio = talkative(0.2);
    let (mut game, plan) = open_to(by_radio.clone(), &["192.0.2.1".parse().expect("an address")]);
    game.world_mut().insert_resource(RequestLog::default());
    let mut manager = Manager::of(&plan, HOME_1, 0.0);
    manager.talk.subscribe(Subscription { images_hz: 30.0, data_hz: 30.0 });
    manager.talk.steer(Some(Pilot { throttle: 1.0, ..Pilot::default() }), Duration::ZERO);
    let answer = manager.give(&mut game, play("mine.ron", long_strategy("Sent")));
    assert!(matches!(answer, ChaosNews::Unanswered(_)), "{answer:?}");
    assert_eq!((manager.talk.heard(), log_of(&game)), (None, RequestLog::default()));
    let figures = figures(&game);
    assert!(figures.orders.foreign > 1_000, "{figures:?}");
    assert_eq!((figures.orders.obeyed, figures.data.put_in), (0, 0));
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(game.record().digest, digest_of(&by_radio));
}

#[test]
fn a_flood_is_counted_a_bounded_part_in_each_tick_and_changes_nothing() {
    let by_radio = talkative(0.1);
    let (mut game, plan) = open_to(by_radio.clone(), &[]);
    let (socket, [images, data, orders]) = (stranger(), sockets(&plan));
    let mut before = 0;
    while !game.is_over() {
        for _ in 0..200 {
            socket.send_to(b"TCM", orders).expect("it is sent");
        }
        for to in [images, data] {
            socket.send_to(b"TCM", to).expect("it is sent");
        }
        game.tick();
        let now = figures(&game).orders.malformed;
        assert!((1..=128 + 2).contains(&(now - before)), "{} in a tick", now - before);
        before = now;
    }
    assert!(before > 10_000, "{before}");
    assert_eq!(game.record().digest, digest_of(&by_radio));
}

#[test]
fn a_tick_reads_one_strategy_at_most_and_what_is_no_order_is_counted() {
    let (mut game, plan) = open_to(talkative(0.2), &[]);
    let (socket, [.., to]) = (stranger(), sockets(&plan));
    let say = |from: Peer, robot: Peer, number: u32| {
        let order = ChaosOrder { number, instruction: play("mine.ron", "(name: 7)".into()) };
        let message = ExternalMessage::of(&order, from, robot);
        for datagram in cut(&message, number, USUAL_DATAGRAM).expect("it can be sent") {
            socket.send_to(&datagram, to).expect("it is sent");
        }
    };
    let computer = Peer::Computer(0);
    (0..5).for_each(|number| say(computer, HOME_0.into(), number));
    say(HOME_1.into(), HOME_0.into(), 5);
    say(computer, Peer::Team(0), 6);
    game.tick();
    let orders = figures(&game).orders;
    assert_eq!((orders.refused, orders.postponed, orders.malformed), (1, 4, 2));
    (0..5).for_each(|number| say(computer, HOME_0.into(), number));
    game.tick();
    let orders = figures(&game).orders;
    assert_eq!((orders.refused, orders.postponed, orders.repeated), (2, 7, 1));
    say(computer, Peer::Robot { team: 0, number: 9 }, 7);
    game.tick();
    assert_eq!(figures(&game).orders.refused, 3, "there is no such robot");
}
