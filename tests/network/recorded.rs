//! Matches with sockets, and the same matches from their requests without any.

use touchline::comms::messages::TeamMessage;
use touchline::comms::tcm::Peer;
use touchline::game::net::{self, UdpCarrier};
use touchline::game::requests::{RemoteNews, Request, RequestLog};
use touchline::game::{Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::world::gamecontroller::BoxNews;
use touchline::world::gamecontroller::control::Penalty;
use touchline::world::gamecontroller::referee_box::Penalised;

use super::greeting::{Elsewhere, with_remote};
use super::referee_box::{IN_THE_EASTERN_GOAL, Refereed, put_ball};
use super::{HOME_0, HOME_1, address_of, datagram, greet, stranger, talkative};

const AWAY_2: RobotId = RobotId::new(Team::Away, 2);

/// The match without sockets, with these requests.
pub(super) fn again(plan: &MatchPlan, requests: &[(u64, Request)], ticks: u64) -> Match {
    let mut game = Match::new(&MatchPlan { script: requests.to_vec(), ..plan.clone() });
    (0..ticks).for_each(|_| game.tick());
    game
}

pub(super) fn log_of(game: &Match) -> RequestLog {
    game.world().resource::<RequestLog>().clone()
}

#[test]
fn a_match_with_a_referee_box_and_a_remote_robot_is_played_again_from_its_requests() {
    let mut refereed = Refereed::new(with_remote(talkative(10.0), &[HOME_1]));
    refereed.game.world_mut().insert_resource(RequestLog::default());
    let mut robot = Elsewhere::start(&refereed.plan, HOME_1);
    greet(&mut refereed.game);
    refereed.begin();
    let (stranger, to) = (stranger(), address_of(&refereed.plan, HOME_0));
    for times in 0..5 {
        refereed.ticks(40);
        refereed.send(b"hello");
        let text = datagram(Peer::Computer(0), HOME_0.into(), times, &TeamMessage::Text("hello".into()));
        stranger.send_to(&text, to).expect("it is sent");
    }
    put_ball(&mut refereed.game, IN_THE_EASTERN_GOAL);
    let pushed = Penalised { player: 2, penalty: Penalty::Pushing, seconds_left: 30 };
    refereed.say(|says| (says.penalties[1], says.score) = (vec![pushed], [1, 0]));
    refereed.ticks(100);
    robot.stop();
    net::grant(refereed.game.world_mut(), std::time::Duration::ZERO);
    refereed.ticks(100);

    let Refereed { game, plan, .. } = refereed;
    let RequestLog(requests) = log_of(&game);
    let counted = |is: fn(&Request) -> bool| requests.iter().filter(|(_, request)| is(request)).count();
    assert!(counted(|request| matches!(request, Request::RefereeBox { .. })) > 15);
    assert!(counted(|request| matches!(request, Request::Remote(_, RemoteNews::Wants { .. }))) > 200);
    assert!(counted(|request| matches!(request, Request::Remote(_, RemoteNews::Silent))) > 0);
    assert!(counted(|request| matches!(request, Request::Datagram(_))) > 500);
    let ticks = game.clock().tick;
    let second = again(&plan, &requests, ticks);
    assert_eq!(second.record().digest, game.record().digest);
    assert_eq!(second.state(), game.state());
    let heard = |game: &Match| game.world().resource::<BoxNews>().heard();
    assert_eq!((heard(&second), heard(&second).not_ours), (heard(&game), 5));
    assert!(net::remote_figures(second.world()).is_empty());
    assert_eq!(second.world().resource::<UdpCarrier>().figures.received, 0, "it has no sockets");
    let kinds: [fn(&Request) -> bool; 4] = [
        |request| matches!(request, Request::RefereeBox { .. }),
        |request| matches!(request, Request::Remote(..)),
        |request| matches!(request, Request::Datagram(_)),
        |request| matches!(request, Request::Body(_)),
    ];
    for missing in kinds {
        let rest: Vec<_> = requests.iter().filter(|(_, request)| !missing(request)).cloned().collect();
        assert_ne!(again(&plan, &rest, ticks).record().digest, game.record().digest);
    }
}

/// The digest of a match with these robots in other processes, and whether all were in time.
fn played_with(remote: &[RobotId]) -> (u64, bool) {
    let (mut game, plan) = super::open(&with_remote(talkative(0.05), remote));
    let robots: Vec<_> = remote.iter().map(|robot| Elsewhere::start(&plan, *robot)).collect();
    greet(&mut game);
    while !game.is_over() {
        game.tick();
    }
    let missed: u64 = net::remote_figures(game.world()).iter().map(|figures| figures.missed).sum();
    net::finish(game.world_mut());
    drop(robots);
    (game.record().digest, missed == 0)
}

#[test]
fn a_match_between_processes_goes_the_same_way_again_if_all_robots_are_in_time() {
    let remote = [HOME_0, HOME_1, AWAY_2];
    let mut played = 0;
    let mut in_time = || {
        (0..10)
            .map(|_| played_with(&remote))
            .inspect(|_| played += 1)
            .find_map(|(digest, in_time)| in_time.then_some(digest))
            .expect("in one of ten matches everybody is in time")
    };
    let digests = [in_time(), in_time()];
    println!("{played} matches were played until two had everybody in time");
    assert_eq!(digests[0], digests[1]);
}
