//! The roles of a strategy: which machine each plays, in which zone, and from which homebases.

use bevy::prelude::Vec2;

use super::{Resolved, Resolver};
use crate::data::Field;
use crate::geometry::Zone;
use crate::strategy::file::{RoleFile, SubRoleFile};
use crate::strategy::pieces::{HomebaseRule, Part, Play, RoleSpec, SubRole};

impl Resolver<'_> {
    pub(super) fn role(&mut self, name: &str, file: &RoleFile, at: &Field) -> Resolved<RoleSpec> {
        let (tag, part) = match file {
            RoleFile::Plays { tag, machine, danger_zone, homebases, homebase_rule } => {
                let machine = self.index(&self.file.machines, "machine", machine, &at.key("machine"))?;
                self.sound_zone(*danger_zone, &at.key("danger_zone"))?;
                let homebases = self.homebases(homebases, &at.key("homebases"))?;
                let homebase_rule = self.homebase_rule(homebase_rule, &at.key("homebase_rule"))?;
                let danger_zone = danger_zone.scaled(self.scale);
                (tag, Part::Plays(Play { machine, danger_zone, homebases, homebase_rule }))
            }
            RoleFile::StandsIn { tag, role, homebase_rule } => {
                let whose = Field::root().key("roles").key(role);
                let stood_in_for = match self.file.roles.get(role) {
                    Some(file @ RoleFile::Plays { .. }) => self.role(role, file, &whose)?.part,
                    Some(_) => {
                        return self.fault(&at.key("role"), "stands in for a role that plays a machine");
                    }
                    None => {
                        return self.fault(&at.key("role"), super::unknown(&self.file.roles, "role", role));
                    }
                };
                let rule =
                    homebase_rule.as_ref().map(|rule| self.homebase_rule(rule, &at.key("homebase_rule")));
                (tag, stood_in_for.with_homebase_rule(rule.transpose()?))
            }
            RoleFile::ActsAs { tag, sub_roles } => {
                (tag, Part::ActsAs(self.sub_roles(sub_roles, &at.key("sub_roles"))?))
            }
        };
        Ok(RoleSpec { name: name.into(), tag: tag.clone(), part })
    }

    fn homebases(&self, homebases: &[Vec2], at: &Field) -> Resolved<Vec<Vec2>> {
        if homebases.is_empty() {
            return self.fault(at, "needs at least one homebase");
        }
        for (i, home) in homebases.iter().enumerate() {
            self.place(*home, &at.index(i))?;
        }
        Ok(homebases.iter().map(|home| *home * self.scale).collect())
    }

    fn homebase_rule(&mut self, rule: &HomebaseRule, at: &Field) -> Resolved<HomebaseRule> {
        let mut rule = rule.clone();
        if let HomebaseRule::FarthestFrom(role) | HomebaseRule::NotNearestOf(role) = &mut rule {
            self.role_ref(role, at)?;
        }
        Ok(rule)
    }

    fn sub_roles(&mut self, files: &[SubRoleFile], at: &Field) -> Resolved<Vec<SubRole>> {
        let mut sub_roles = Vec::with_capacity(files.len());
        for (i, sub_role) in files.iter().enumerate() {
            let at = at.index(i);
            let role = self.index(&self.file.roles, "role", &sub_role.role, &at.key("role"))?;
            if matches!(self.file.roles.get(&sub_role.role), Some(RoleFile::ActsAs { .. })) {
                return self.fault(&at.key("role"), "a sub-role must be a role that plays a machine");
            }
            sub_roles.push(SubRole { when: self.resolved_feature(&sub_role.when, &at.key("when"))?, role });
        }
        if sub_roles.is_empty() {
            return self.fault(at, "needs at least one sub-role");
        }
        Ok(sub_roles)
    }

    /// The zone of control of a role that plays a machine, as it is played.
    pub(super) fn danger_zone_of(&self, role: &str, at: &Field) -> Resolved<Zone> {
        let roles = &self.file.roles;
        let played = match roles.get(role) {
            Some(RoleFile::StandsIn { role, .. }) => roles.get(role),
            other => other,
        };
        match played {
            Some(RoleFile::Plays { danger_zone, .. }) => Ok(danger_zone.scaled(self.scale)),
            Some(_) => self.fault(at, format!("`{role}` has no zone of control of its own")),
            None => self.fault(at, super::unknown(roles, "role", role)),
        }
    }
}

impl Part {
    fn with_homebase_rule(self, rule: Option<HomebaseRule>) -> Part {
        match (self, rule) {
            (Part::Plays(play), Some(homebase_rule)) => Part::Plays(Play { homebase_rule, ..play }),
            (part, _) => part,
        }
    }
}
