//! `touchline robot`: one robot of a match that is elsewhere.

use std::io::{self, Write};
use std::net::SocketAddr;

use clap::{Args, ValueEnum};

use super::ending::{CommandError, Ending, tell};
use super::interrupt::Interrupt;
use super::options::{MatchOptions, SeedOption};
use crate::comms::tcm::Peer;
use crate::data::AssetFolder;
use crate::game::net::{NetworkError, RobotEnd, RobotProcess, RobotReport};
use crate::ids::{RobotId, Team};

#[derive(Args, Debug)]
pub(super) struct RobotCommand {
    /// Its team.
    #[arg(long)]
    team: TeamChoice,
    /// Its number on the shirt, from 0.
    #[arg(long)]
    number: u8,
    /// Where it listens to its match and its team mates; its place in the addresses if not given.
    #[arg(long, value_name = "ADDRESS")]
    bind: Option<SocketAddr>,
    /// The match that it takes part in: the same as where the match is played.
    #[command(flatten)]
    options: MatchOptions,
    #[command(flatten)]
    seed: SeedOption,
    /// Print the counts of its messages as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum TeamChoice {
    Home,
    Away,
}

impl RobotCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plan = self.options.plan(assets, &self.seed)?;
        let team = match self.team {
            TeamChoice::Home => Team::Home,
            TeamChoice::Away => Team::Away,
        };
        let id = RobotId::new(team, self.number);
        plan.check_robot("--number", Some(id))?;
        let peer = Peer::from(id);
        let bind = self.bind.or_else(|| plan.directory().address_of(peer));
        let bind = bind.ok_or(NetworkError::NoAddress(peer))?;
        let interrupt = Interrupt::listen();
        let patience = self.options.patience();
        let report = RobotProcess::open(&plan, id, bind)?.play(patience, &|| interrupt.is_asked())?;
        if self.json {
            super::ending::print_json(&report, out)?;
        } else {
            print(&report, out)?;
        }
        Ok(match report.ending {
            RobotEnd::MatchOver => Ending::Done,
            RobotEnd::Stopped => Ending::Interrupted,
            RobotEnd::MatchGone => {
                tell(format_args!("{id} has heard nothing of its match for {} s", patience.as_secs_f32()));
                Ending::Failed
            }
        })
    }
}

fn print(report: &RobotReport, out: &mut impl Write) -> io::Result<()> {
    let figures = report.datagrams;
    writeln!(out, "{} answered {} ticks", report.robot, report.answered)?;
    writeln!(out, "datagrams: {} sent to robots, {} received from them", figures.sent, figures.received)?;
    writeln!(
        out,
        "{} from computers, {} from nobody we know, {} not sent",
        figures.from_computers, figures.foreign, figures.refused
    )
}
