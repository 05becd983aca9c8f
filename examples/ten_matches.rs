//! Plays ten short matches with different seeds and prints a table: `cargo run --example ten_matches`.
//!
//! Strategies of your own: `cargo run --example ten_matches my_team.ron ball_chasers`.

use std::process::ExitCode;

use touchline::data::{AssetFolder, DataError};
use touchline::game::record::CROWD;
use touchline::game::{Choice, Match, MatchPlan};

fn main() -> ExitCode {
    let mut teams = std::env::args().skip(1);
    match play(teams.next(), teams.next()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn play(home: Option<String>, away: Option<String>) -> Result<(), DataError> {
    let assets = AssetFolder::find(None)?;
    let choice = Choice { home, away, half_minutes: Some(1.0), ..Choice::default() };
    println!("seed  score  possession  crowding     driven");
    for seed in 1..=10 {
        let plan = MatchPlan::read(&assets, &Choice { seed, ..choice.clone() })?;
        let mut game = Match::new(&plan);
        while !game.is_over() {
            game.tick();
        }
        let ([home, away], record) = (game.state().score, game.record());
        let possession = record.possession_shares().map(|share| 100.0 * share);
        let crowding = record.crowding.seconds(CROWD).map(|seconds| 100.0 * seconds / record.played);
        let driven = touchline::ids::Team::BOTH.map(|team| record.driven_by(team));
        println!(
            "{seed:4}  {home} : {away}  {:3.0} : {:2.0} %  {:3.0} : {:2.0} %  {:3.0} : {:3.0} m",
            possession[0], possession[1], crowding[0], crowding[1], driven[0], driven[1]
        );
    }
    Ok(())
}
