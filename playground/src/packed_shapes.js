// The meshes of the page's scenes, compressed and as text. The build puts them in.
const base64 = "@SHAPES@";

let unpacked;

/** By name: vertices and faces. */
export function shapes() {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return (unpacked ??= new Response(stream).json());
}
