//! A scene of equal bodies as a peer of bench/scenes_bench.cpp; the protocol is in bench/peer_scene.h. Parry's tree of
//! boxes finds the pairs whose boxes, around both ends of the step, overlap, and `cast_shapes_nonlinear` tests each of them.

use crate::{body, numbers, rotation, Outcome};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::{cast_shapes_nonlinear, NonlinearRigidMotion};
use parry3d_f64::shape::Shape;
use std::time::Instant;

#[derive(Default)]
pub struct Scene {
    shape: Option<Box<dyn Shape>>,
    starts: Vec<Pose>,
    goals: Vec<Pose>,
}

fn poses(text: &str) -> Outcome<Vec<Pose>> {
    let mut words = text.split(' ');
    words.next();
    let values = numbers(words)?;
    Ok(values.chunks_exact(7).map(|p| Pose::from_parts(Vector::new(p[4], p[5], p[6]), rotation(p))).collect())
}

/// The centre of the shape's box moves straight, and the body turns about it, both at constant rates.
fn motion(shape: &dyn Shape, start: &Pose, goal: &Pose) -> NonlinearRigidMotion {
    let centre = shape.compute_local_aabb().center();
    let travel = goal.transform_point(centre) - start.transform_point(centre);
    let turn = (goal.rotation * start.rotation.inverse()).to_scaled_axis();
    NonlinearRigidMotion::new(*start, centre, travel, turn)
}

impl Scene {
    fn pass(&self) -> Outcome<String> {
        let shape = self.shape.as_deref().ok_or("no body")?;
        let began = Instant::now();
        let ends = || self.starts.iter().zip(&self.goals);
        let motions: Vec<_> = ends().map(|(start, goal)| motion(shape, start, goal)).collect();
        let boxes: Vec<Aabb> = ends().map(|(start, goal)| shape.compute_swept_aabb(start, goal)).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        let mut found = String::new();
        for (i, aabb) in boxes.iter().enumerate() {
            for other in tree.intersect_aabb(aabb) {
                let j = other as usize;
                if i < j && cast_shapes_nonlinear(&motions[i], shape, &motions[j], shape, 0.0, 1.0, true)?.is_some() {
                    found += &format!(" {i} {j}");
                }
            }
        }
        Ok(format!("found {}{found}", began.elapsed().as_secs_f64()))
    }

    pub fn reply(&mut self, line: &str) -> Outcome<String> {
        match line.split_once(' ').unwrap_or((line, "")) {
            ("body", rest) => self.shape = Some(body(rest, false)?),
            ("place", rest) => self.starts = std::mem::replace(&mut self.goals, poses(rest)?),
            ("pass", _) => return self.pass(),
            _ => return Err("not a question".into()),
        }
        Ok("done".into())
    }
}
