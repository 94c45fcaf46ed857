// Modules that playground/build.mjs makes.
declare module "shapes" {
  export function shapes(): Promise<Record<string, { vertices: number[][]; faces: number[][] }>>;
}
declare module "places" {
  export const places: { key: number[]; planet: number[]; nut: number };
}
