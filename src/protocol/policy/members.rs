//! The robots of the cast, what they bid, and how a new distribution of duties becomes a reassignment.

use crate::geometry::Vec2;
use smallvec::SmallVec;

use super::knowledge::{ColumnValues, Duty, Knowledge, SwapRoles};
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::Reassignment;

/// A robot with a role of the cast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    pub number: PlayerNumber,
    pub duty: Duty,
    pub position: Vec2,
    pub heading: f32,
}

/// In order of their numbers.
pub(super) type Members = SmallVec<[Member; 4]>;

/// A member and its values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bidder {
    pub member: Member,
    pub values: ColumnValues,
    pub wish: Option<u8>,
}

/// Who should have which duty: the new one beside each member.
pub(super) type Distribution = SmallVec<[(Member, Duty); 4]>;

/// The members that were heard of lately.
pub(super) fn members(cast: &SwapRoles, knowledge: &Knowledge) -> Members {
    let players = knowledge.players.iter().filter(|player| player.position.is_finite());
    let member = |player: &super::knowledge::Player| {
        let duty = cast.duty(player.role)?;
        Some(Member { number: player.number, duty, position: player.position, heading: player.heading })
    };
    players.filter_map(member).collect()
}

/// This robot, if it is a member.
pub(super) fn me(members: &[Member], knowledge: &Knowledge) -> Option<Member> {
    members.iter().copied().find(|member| member.number == knowledge.me)
}

/// The members whose values are sound and not older than `max_age` seconds, this robot with its own values `mine`. The others
/// are left out: they keep their roles.
pub(super) fn bidders(
    cast: &SwapRoles,
    knowledge: &Knowledge,
    mine: (ColumnValues, Option<u8>),
    max_age: f32,
) -> SmallVec<[Bidder; 4]> {
    let columns = mine.0.len();
    let bidder = |member: Member| {
        let (values, wish) = if member.number == knowledge.me {
            mine.clone()
        } else {
            let player = knowledge.players.iter().find(|player| player.number == member.number)?;
            let valued = player.values.as_ref().filter(|valued| valued.age <= max_age)?;
            (valued.values.clone(), valued.wish)
        };
        let sound = values.len() == columns && values.iter().all(|value| value.is_finite());
        sound.then_some(Bidder { member, values, wish })
    };
    members(cast, knowledge).into_iter().filter_map(bidder).collect()
}

/// The bidder with the highest value in a column.
pub(super) fn highest(bidders: &[Bidder], column: usize) -> Option<Member> {
    let best = bidders.iter().reduce(|a, b| if b.values[column] > a.values[column] { b } else { a });
    best.map(|bidder| bidder.member)
}

/// The duties for these members to share, as many as there are members: those that they have, and the first of those that
/// nobody has in place of doubled ones. Members that were not heard of keep theirs that way. `None` if there are more
/// members than duties.
pub(super) fn duties(members: &[Member]) -> Option<SmallVec<[Duty; 3]>> {
    let held = |duty: &Duty| members.iter().any(|member| member.duty == *duty);
    let (taken, free): (SmallVec<[Duty; 3]>, SmallVec<[Duty; 3]>) = Duty::ALL.into_iter().partition(held);
    let mut duties: SmallVec<[Duty; 3]> = taken.into_iter().chain(free).take(members.len()).collect();
    duties.sort_unstable();
    (duties.len() == members.len()).then_some(duties)
}

/// Fills duties in the given order of importance, each with the member that has the highest value for it, given the member's
/// place in the list, of those that are left.
pub(super) fn by_importance(
    members: &[Member],
    order: [Duty; 3],
    value: impl Fn(usize, Duty) -> f32,
) -> Option<Distribution> {
    let to_share = duties(members)?;
    let mut left: SmallVec<[usize; 4]> = (0..members.len()).collect();
    let mut distribution = Distribution::new();
    for duty in order.into_iter().filter(|duty| to_share.contains(duty)) {
        let best =
            (0..left.len()).reduce(|a, b| if value(left[b], duty) > value(left[a], duty) { b } else { a })?;
        distribution.push((members[left.remove(best)], duty));
    }
    Some(distribution)
}

/// The player that gains the first duty that changes hands.
pub(super) fn first_to_gain(distribution: &Distribution) -> Option<PlayerNumber> {
    let gain = distribution.iter().find(|(member, duty)| member.duty != *duty);
    gain.map(|(member, _)| member.number)
}

/// The reassignment that brings a distribution about, if it changes anything.
pub(super) fn reassignment(cast: &SwapRoles, distribution: &Distribution) -> Option<Reassignment> {
    let changes = distribution.iter().filter(|(member, duty)| member.duty != *duty);
    let changes: SmallVec<_> = changes.map(|(member, duty)| (member.number, cast.role(*duty))).collect();
    (!changes.is_empty()).then_some(Reassignment::Robots(changes))
}

/// The reassignment by which a robot takes a duty and gives its own in return.
pub(super) fn exchange(
    cast: &SwapRoles,
    taker: Member,
    duty: Duty,
    members: &[Member],
) -> Option<Reassignment> {
    let holder = members.iter().find(|member| member.duty == duty);
    let in_return = holder.map(|holder| (*holder, taker.duty));
    reassignment(cast, &[(taker, duty)].into_iter().chain(in_return).collect())
}

/// Whether all who hold a duty agree to part with it. A duty that nobody seems to hold is free only once enough members were
/// heard of for all three; else its holder may just be silent.
pub(super) fn is_given_up(members: &[Member], duty: Duty, agrees: impl Fn(PlayerNumber) -> bool) -> bool {
    let mut holders = members.iter().filter(|member| member.duty == duty).peekable();
    if holders.peek().is_none() {
        members.len() >= Duty::ALL.len()
    } else {
        holders.all(|holder| agrees(holder.number))
    }
}
