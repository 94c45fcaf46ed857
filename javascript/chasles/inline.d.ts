// For TypeScript where it does not read "exports" (moduleResolution "node"): "chasles/inline" has the types of "chasles".
export * from "./index.js";
