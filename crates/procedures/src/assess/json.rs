//! Serialisation of an assessment: the answers, without the fits, samples and
//! curves behind them.

use std::collections::BTreeMap;

use rocking_statistics::Estimate;
use rocking_statistics::estimate::keys;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::{
    Answer, ObjectAssessment, ObjectFacts, ObjectState, SlidingObject,
};

impl Answer {
    fn entries<M: SerializeMap>(&self, to: &mut M) -> Result<(), M::Error> {
        let Self { fitted, median_im, small_im, risk: _ } = self;
        to.serialize_entry("median_im", median_im)?;
        to.serialize_entry("im_at_5_percent", small_im)?;
        to.serialize_entry("records", fitted.records())?;
        to.serialize_entry("model_bias", &fitted.bias())?;
        let dispersion = fitted.model_dispersion();
        to.serialize_entry("model_dispersion", &dispersion)?;
        to.serialize_entry("annual_frequency", &self.annual_frequency())?;
        to.serialize_entry("probability", &self.probability())
    }
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut to = to.serialize_map(None)?;
        self.entries(&mut to)?;
        to.end()
    }
}

/// The probability of damage at an intensity of the hazard curve.
#[derive(Serialize)]
struct DamagePoint {
    im: f64,
    #[serde(flatten, serialize_with = "keys::p")]
    p: Estimate,
}

impl ObjectFacts {
    fn entries<M: SerializeMap>(
        &self,
        state: ObjectState,
        to: &mut M,
    ) -> Result<(), M::Error> {
        // Without `..`: a new field has to be placed here.
        let Self {
            object,
            damage,
            width_m,
            height_m,
            uplift_pga_g,
            lean_m,
            falls_on,
            remarks,
        } = self;
        let floor = object.floor.as_ref().map(|on| &on.name);
        let notes = object.notes.iter().map(|(head, cell)| (head, cell));
        to.serialize_entry("id", &object.id)?;
        to.serialize_entry("label", &object.label)?;
        to.serialize_entry("state", &state)?;
        to.serialize_entry("remarks", remarks)?;
        to.serialize_entry("notes", &notes.collect::<BTreeMap<_, _>>())?;
        to.serialize_entry("position_m", &object.position_m)?;
        to.serialize_entry("width_m", width_m)?;
        to.serialize_entry("height_m", height_m)?;
        to.serialize_entry("alpha_rad", &object.block.slenderness_rad())?;
        to.serialize_entry("p_rad_s", &object.block.frequency_rad_s())?;
        to.serialize_entry("eta", &object.restitution.velocity_ratio())?;
        to.serialize_entry("friction", &object.friction)?;
        to.serialize_entry("floor", &floor)?;
        to.serialize_entry("damage", &damage.to_string())?;
        to.serialize_entry("onset_pga_g", uplift_pga_g)?;
        to.serialize_entry("lean_m", lean_m)?;
        to.serialize_entry("falls_on", falls_on)
    }
}

impl Serialize for SlidingObject {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { facts, share, needed_friction } = self;
        let needed = Some(needed_friction).filter(|mu| mu.is_finite());
        let mut to = to.serialize_map(None)?;
        facts.entries(ObjectState::NotRocking, &mut to)?;
        to.serialize_entry("friction_share", share)?;
        to.serialize_entry("needed_friction", &needed)?;
        to.end()
    }
}

impl Serialize for ObjectAssessment {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        // Without `..`: a new field has to be placed here.
        let Self {
            facts,
            fragility,
            answer,
            parts,
            target,
            remedies,
            band,
            contributions,
            ida: _,
            by_record,
            ranking: _,
            alternatives,
            slides_first,
            resolution,
            first_in_draws,
        } = self;
        let best = self.best_im();
        let edges = contributions.iter();
        let edges: Vec<f64> =
            edges.flat_map(|c| [c.from_im, c.to_im]).collect();
        let band = band.iter().flat_map(|band| &band.points);
        let at_hazard = band.filter(|point| edges.contains(&point.intensity));
        let p_damage = at_hazard.map(|point| DamagePoint {
            im: point.intensity,
            p: point.probability,
        });
        let standing = by_record.iter().filter(|r| !r.damages).count();
        let needed = fragility.needed.as_ref().map(|n| n.for_median);
        let mut to = to.serialize_map(None)?;
        facts.entries(self.state(), &mut to)?;
        answer.entries(&mut to)?;
        let years = answer.return_period_years();
        to.serialize_entry("return_period_years", &years)?;
        to.serialize_entry("parts", parts)?;
        to.serialize_entry("target", target)?;
        to.serialize_entry("remedies", remedies)?;
        to.serialize_entry("p_damage", &p_damage.collect::<Vec<_>>())?;
        to.serialize_entry("contributions", contributions)?;
        to.serialize_entry("first_in_draws", first_in_draws)?;
        to.serialize_entry("friction_share", slides_first)?;
        to.serialize_entry("unresolved", &resolution.unresolved)?;
        to.serialize_entry("analyses", &resolution.analyses)?;
        to.serialize_entry("records_without_damage", &standing)?;
        to.serialize_entry("best_im", &best.map(|best| best.0))?;
        to.serialize_entry("best_im_dispersion", &best.map(|best| best.1))?;
        to.serialize_entry("records_needed", &needed)?;
        to.serialize_entry("alternatives", alternatives)?;
        to.end()
    }
}
