//! `touchline robot`: one robot of a match that is elsewhere.

use std::net::SocketAddr;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::MatchOptions;
use crate::data::{AssetFolder, DataError};
use crate::ids::{RobotId, Team};
use crate::tcm::party;
use crate::wire::{RobotEnd, RobotProcess, WireError};

#[derive(Args, Debug)]
pub(super) struct Robot {
    /// Its team.
    #[arg(long)]
    team: Side,
    /// Its number on the shirt, from 0.
    #[arg(long)]
    number: u8,
    /// Where it listens to its match and its team mates; its place in the addresses if not given.
    #[arg(long, value_name = "ADDRESS")]
    bind: Option<SocketAddr>,
    /// The match that it takes part in: the same as where the match is played.
    #[command(flatten)]
    options: MatchOptions,
    /// Print what became of its messages as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Side {
    Home,
    Away,
}

impl Robot {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        let elsewhere = [
            ("--announce", self.options.announce.is_some()),
            ("--league-ports", self.options.league_ports.is_some()),
        ];
        if let Some((option, _)) = elsewhere.into_iter().find(|(_, given)| *given) {
            return Err(DataError::new(option, "is for the match, not for one of its robots"));
        }
        let plan = self.options.plan(assets, None)?;
        let team = match self.team {
            Side::Home => Team::Home,
            Side::Away => Team::Away,
        };
        let id = RobotId::new(team, self.number);
        plan.check_robot("--number", Some(id))?;
        let entity = party(id);
        let bind = self.bind.or_else(|| plan.directory().address_of(entity));
        let bind = bind.ok_or(WireError::NoAddress(entity))?;
        let patience = self.options.patience();
        let report = RobotProcess::open(&plan, id, bind)?.play(patience, &|| false)?;
        if self.json {
            println!("{}", serde_json::to_string_pretty(&report).unwrap_or_else(|error| error.to_string()));
        } else {
            let figures = report.datagrams;
            println!("{id} answered {} ticks", report.answered);
            println!("datagrams: {} sent to robots, {} received from them", figures.sent, figures.received);
            println!(
                "{} from computers, {} from nobody we know, {} not sent",
                figures.from_computers, figures.foreign, figures.refused
            );
        }
        if report.ending == RobotEnd::MatchGone {
            eprintln!("{id} has heard nothing of its match for {} s", patience.as_secs_f32());
            return Ok(ExitCode::FAILURE);
        }
        Ok(ExitCode::SUCCESS)
    }
}
