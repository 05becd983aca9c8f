//! Robots in files, as people write them: `"home 2"`.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::ids::RobotId;

struct Text(RobotId);

impl Serialize for Text {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for Text {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Text, D::Error> {
        String::deserialize(deserializer)?.parse().map(Text).map_err(D::Error::custom)
    }
}

pub(super) fn serialize<S: Serializer>(robot: &RobotId, serializer: S) -> Result<S::Ok, S::Error> {
    Text(*robot).serialize(serializer)
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<RobotId, D::Error> {
    Text::deserialize(deserializer).map(|text| text.0)
}

/// A robot or none.
pub(super) mod option {
    use super::*;

    pub(in super::super) fn serialize<S: Serializer>(
        robot: &Option<RobotId>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        robot.map(Text).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<RobotId>, D::Error> {
        Ok(Option::<Text>::deserialize(deserializer)?.map(|text| text.0))
    }
}

/// Any number of robots.
pub(super) mod list {
    use super::*;

    pub(in super::super) fn serialize<S: Serializer>(
        robots: &[RobotId],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(robots.iter().copied().map(Text))
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<RobotId>, D::Error> {
        Ok(Vec::<Text>::deserialize(deserializer)?.into_iter().map(|text| text.0).collect())
    }
}
