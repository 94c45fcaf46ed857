// The meshes of the page's scenes, compressed and as text. The build puts them in.
const base64 = "@SHAPES@";

let unpacked;

/** By name: vertices and faces. */
export function shapes() {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return (unpacked ??= new Response(stream).json());
}
