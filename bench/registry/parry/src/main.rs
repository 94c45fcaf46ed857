//! Parry as a peer of bench/peers_bench.cpp; the protocol is in bench/process_peer.h.
//!
//! Usage: parry_peer mesh | convex | scene
//!
//! `cast_shapes_nonlinear` on triangle meshes, on convex polyhedra, or on all pairs of a scene (scene.rs).

mod scene;

use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::{cast_shapes_nonlinear, NonlinearRigidMotion};
use parry3d_f64::shape::{ConvexPolyhedron, Shape, TriMesh};
use std::error::Error;
use std::io::{self, BufRead, Write};
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn numbers<'a>(words: impl Iterator<Item = &'a str>) -> Outcome<Vec<f64>> {
    Ok(words.map(str::parse).collect::<Result<_, _>>()?)
}

fn body(text: &str, is_convex: bool) -> Outcome<Box<dyn Shape>> {
    let mut words = text.split(' ');
    let count: usize = words.next().ok_or("no vertices")?.parse()?;
    words.next();
    let values = numbers(words)?;
    if values.len() < 3 * count {
        return Err("too few numbers".into());
    }
    let (coordinates, corners) = values.split_at(3 * count);
    let vertices: Vec<Vector> = coordinates.chunks_exact(3).map(|p| Vector::new(p[0], p[1], p[2])).collect();
    let triangles: Vec<[u32; 3]> = corners.chunks_exact(3).map(|t| [t[0] as u32, t[1] as u32, t[2] as u32]).collect();
    if is_convex {
        let hull = ConvexPolyhedron::from_convex_mesh(vertices, &triangles).ok_or("not convex for Parry")?;
        return Ok(Box::new(hull));
    }
    Ok(Box::new(TriMesh::new(vertices, triangles)?))
}

fn rotation(q: &[f64]) -> Rotation {
    Rotation::from_xyzw(q[1], q[2], q[3], q[0])
}

/// The screw with constant rates: a rotation about a point of its axis, while this point moves along the axis.
fn motion(start: &[f64], goal: &[f64]) -> NonlinearRigidMotion {
    let origin = Vector::new(start[0], start[1], start[2]);
    let travel = Vector::new(goal[0], goal[1], goal[2]) - origin;
    let pose = Pose::from_parts(origin, rotation(&start[3..]));
    let mut turn = rotation(&goal[3..]) * rotation(&start[3..]).inverse();
    if turn.w < 0.0 {
        turn = -turn;
    }
    let turned = Vector::new(turn.x, turn.y, turn.z);
    let sine = turned.length();
    if sine < 1e-9 {
        return NonlinearRigidMotion::new(pose, Vector::ZERO, travel, Vector::ZERO);
    }
    let axis = turned / sine;
    let slide = axis * travel.dot(axis);
    let across = travel - slide;
    let centre = origin + (across + axis.cross(across) * (turn.w / sine)) * 0.5;
    let angle = 2.0 * sine.atan2(turn.w);
    NonlinearRigidMotion::new(pose, pose.inverse_transform_point(centre), slide, axis * angle)
}

fn ask(text: &str, bodies: &[Box<dyn Shape>]) -> Outcome<String> {
    let values = numbers(text.split(' '))?;
    if values.len() != 16 {
        return Err("a question has sixteen numbers".into());
    }
    let (moving, fixed) = (&bodies[values[0] as usize], &bodies[values[1] as usize]);
    let moving_motion = motion(&values[2..9], &values[9..16]);
    let still = NonlinearRigidMotion::identity();
    let start = Instant::now();
    let hit = cast_shapes_nonlinear(&moving_motion, &**moving, &still, &**fixed, 0.0, 1.0, true)?;
    let seconds = start.elapsed().as_secs_f64();
    Ok(match hit {
        Some(hit) => format!("answer 1 {} {seconds}", hit.time_of_impact),
        None => format!("answer 0 - {seconds}"),
    })
}

fn reply(line: &str, is_convex: bool, bodies: &mut Vec<Box<dyn Shape>>) -> Outcome<String> {
    match line.split_once(' ') {
        Some(("body", rest)) => {
            bodies.push(body(rest, is_convex)?);
            Ok("done".into())
        }
        Some(("ask", rest)) => ask(rest, bodies),
        _ => Err("not a question".into()),
    }
}

fn main() -> Outcome<()> {
    let mode = std::env::args().nth(1).unwrap_or_default();
    let mut bodies = Vec::new();
    let mut scene = scene::Scene::default();
    let mut output = io::stdout();
    writeln!(output, "ready")?;
    for line in io::stdin().lock().lines() {
        let line = line?;
        let outcome = if mode == "scene" { scene.reply(&line) } else { reply(&line, mode == "convex", &mut bodies) };
        writeln!(output, "{}", outcome.unwrap_or_else(|error| format!("failed {error}")))?;
    }
    Ok(())
}
