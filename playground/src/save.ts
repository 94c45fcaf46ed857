// The recorded hand as files for `chasles drag`, in one ZIP file.
import type { Pose } from "./poses";
import type { BodyShape, Opened, SceneSpec } from "./protocol";
import type { Session } from "./session";
import { type Entry, zip } from "./zip";

const text = (name: string, content: string): Entry => ({ name, content: new TextEncoder().encode(content) });

/** A name that every system takes as a file name. */
const plain = (name: string) => name.replace(/[^A-Za-z0-9._-]+/g, "-").replace(/^[-.]+/, "") || "body";

/** A mesh that reads back to the same numbers. */
function obj({ vertices, faces }: BodyShape): string {
  const lines: string[] = [];
  for (let i = 0; i < vertices.length; i += 3) lines.push(`v ${vertices[i]} ${vertices[i + 1]} ${vertices[i + 2]}`);
  for (const face of faces) lines.push(`f ${face.map((corner) => corner + 1).join(" ")}`);
  return `${lines.join("\n")}\n`;
}

function csv(poses: Pose[]): string {
  return `${["x,y,z,qw,qx,qy,qz", ...poses.map((pose) => pose.join(","))].join("\n")}\n`;
}

function explanation(name: string, command: string, hasFiles: boolean): string {
  return `A hand that was recorded by the playground of Chasles.

hand.csv     the poses that the hand asked for, one an update
reached.csv  the poses that the body reached on the page, one an update
way.csv      all ends of the pieces of its way there, each of which is a screw that is proven clear
scene.json   the bodies${hasFiles ? ", which are the files as they were dropped" : ""}

${command}

drags "${name}" again, by the native library. The poses differ a little from those on the page: an update of the page may
be cut off to keep its time, and solver and contacts are computed in double, with other roundings. Each way is proven clear.
`;
}

/** Friction and lock, as the command line takes them. */
function optionsOf({ friction, lock }: SceneSpec): string {
  const ofFriction = friction > 0 ? ` --friction ${friction}` : "";
  return lock ? `${ofFriction} --lock ${lock.kind} --lock-axis "${lock.direction.join(" ")}" --lock-point "${lock.point.join(" ")}"` : ofFriction;
}

/** The files, and the name of the ZIP file. */
export function savedHand(title: string, spec: SceneSpec, opened: Opened, session: Session): { name: string; content: Blob } {
  const used = new Set<string>();
  const fileOf = (name: string, extension: string) => {
    let file = plain(name) + extension;
    for (let count = 2; used.has(file); ++count) file = `${plain(name)}-${count}${extension}`;
    used.add(file);
    return file;
  };
  const meshes: Entry[] = [];
  const bodies = spec.bodies.filter(({ isPart }) => !isPart).map(({ name, file }) => {
    const extension = file ? (/\.[A-Za-z0-9]+$/.exec(file.name)?.[0] ?? "") : ".obj";
    const mesh = fileOf(file ? name.replace(/\.[A-Za-z0-9]+$/, "") : name, extension);
    const shape = name === spec.moving ? opened.moving : opened.bodies.find((shape) => shape.name === name)!;
    // a shape is written as it is: its faces have moved inwards already
    const radius = file ? spec.radii[name === spec.moving ? 0 : 1] : shape.radius;
    meshes.push(file ? { name: mesh, content: new Uint8Array(file.content) } : text(mesh, obj(shape)));
    return { name, mesh, ...(radius === 0 ? {} : { radius }), ...(name === spec.moving ? { pose: session.start } : {}) };
  });
  const hasFiles = spec.bodies.some(({ file }) => file);
  const options = `--margin ${opened.margin}${optionsOf(spec)}${hasFiles ? " --triangulate" : ""}`;
  const command = `chasles drag scene.json --body ${JSON.stringify(spec.moving)} --goals hand.csv --out out.csv --page replay.html ${options}`;
  const content = zip([
    text("README.txt", explanation(spec.moving, command, hasFiles)),
    text("scene.json", `${JSON.stringify({ bodies }, null, 2)}\n`),
    text("hand.csv", csv(session.goals)),
    text("reached.csv", csv(session.reached)),
    text("way.csv", csv(session.way)),
    text("drag.sh", `#!/bin/sh\n# Replays the hand. CHASLES names the program.\ncd "$(dirname "$0")"\n${command.replace(/^chasles/, '"${CHASLES:-chasles}"')}\n`),
    ...meshes,
  ]);
  return { name: `hand-${plain(title).toLowerCase()}.zip`, content };
}

/** Offers a file for download. */
export function offer({ name, content }: { name: string; content: Blob }): void {
  const address = URL.createObjectURL(content);
  const link = Object.assign(document.createElement("a"), { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
