//! Ball booking in whole matches of four-legged robots: what it is worth against the crowd around the ball, and what its four
//! requirements come to while robots see badly and the radio loses messages.

use touchline::game::record::{AGGLOMERATION, Record};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::Team;
use touchline::world::referee::Phase;

use crate::support::assets;

fn plan(home: &str, away: &str, seed: u64, half_minutes: f32) -> MatchPlan {
    let choice = Choice {
        file: Some("four_legged_2005".into()),
        home: Some(home.into()),
        away: Some(away.into()),
        half_minutes: Some(half_minutes),
        seed,
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped match is sound")
}

fn played(plan: &MatchPlan) -> Match {
    let mut game = Match::new(plan);
    while !game.is_over() {
        game.tick();
    }
    game
}

/// Share of play with two or more robots of a team within half a metre of the ball.
fn agglomeration(record: &Record, team: Team) -> f64 {
    record.crowding.seconds(AGGLOMERATION)[team.index()] / record.played
}

/// Four matches, each judged three ways: matches are what takes time.
#[test]
fn a_team_that_books_sends_one_robot_agglomerates_less_and_believes_what_is_right_but_for_moments() {
    let (mut crowds, mut driving) = ([0.0; 2], [Driving::default(), Driving::default()]);
    for seed in 1..=2 {
        for (home, away, booking) in
            [("chaos_b3p", "chaos_plain", Team::Home), ("chaos_plain", "chaos_b3p", Team::Away)]
        {
            let game = played(&plan(home, away, seed, 2.0));
            for (place, team) in [booking, booking.opponent()].into_iter().enumerate() {
                crowds[place] += agglomeration(game.record(), team);
                driving[place].add(game.record(), team);
            }
            breaks_its_requirements_for_moments_only(game.record(), booking);
        }
    }
    let [with, without] = crowds;
    assert!(with < 0.5 * without, "{with} with booking, {without} without");
    one_goes_where_others_send_several(&driving);
}

/// Requirements 2 and 4 by what robots do: where their motors take them, not what they believe.
fn one_goes_where_others_send_several([with, without]: &[Driving; 2]) {
    // A robot on its way to a position may walk in the direction of the ball, and counts then.
    assert!(with.several < 0.75 * without.several, "{with:?} with booking, {without:?} without");
    assert!(with.one > 1.3 * without.one, "{with:?} with booking, {without:?} without");
    assert!(with.nobody < 1.5 * without.nobody, "the ball is left alone: {with:?}, {without:?} without");
}

/// What the booking machines believe, on which the robots act.
fn breaks_its_requirements_for_moments_only(record: &Record, team: Team) {
    let figures = &record.bookings[team.index()];
    let renewal_and_delay = 0.5;
    assert!(figures.several_go.longest < renewal_and_delay, "{figures:?}");
    assert!(figures.nobody_goes.longest < renewal_and_delay, "{figures:?}");
    // Robots whose places err differ about who is nearer, until one sees the ball again.
    assert!(figures.farther_goes.longest < 2.0 * renewal_and_delay, "{figures:?}");
    assert!(figures.several_go.total < 0.03 * record.played, "{figures:?}");
    assert!(figures.takeovers > 5, "nobody ever took the ball over");
}

/// Seconds with so many robots of a team that drive at the ball.
#[derive(Debug, Default)]
struct Driving {
    nobody: f64,
    one: f64,
    several: f64,
}

impl Driving {
    fn add(&mut self, record: &Record, team: Team) {
        let pursuit = &record.pursuit[team.index()];
        self.nobody += pursuit.nobody.total;
        self.one += pursuit.one.total;
        self.several += pursuit.several.total;
    }
}

#[test]
fn whole_matches_of_four_legged_robots_end_and_both_kinds_of_robots_can_meet() {
    let mixed = Choice {
        file: Some("four_legged_2005".into()),
        home: Some("hammerheads_2001".into()),
        away: Some("ball_chasers".into()),
        half_minutes: Some(1.0),
        ..Choice::default()
    };
    let mut mixed = MatchPlan::read(&assets(), &mixed).expect("any team can play on any pitch");
    let cyes = MatchPlan::read(&assets(), &Choice::default()).expect("the shipped match is sound");
    mixed.teams[1].kind = cyes.teams[1].kind.clone();
    mixed.teams[1].senses.sensing = cyes.teams[1].senses.sensing.clone();
    for plan in [mixed, plan("chaos_b3p", "chaos_b3p_paper", 3, 1.0)] {
        let game = played(&plan);
        assert_eq!(game.state().phase, Phase::Finished);
        let record = game.record();
        assert!(record.driven_by(Team::Home) > 5.0 && record.driven_by(Team::Away) > 5.0);
    }
}
