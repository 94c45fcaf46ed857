// What a bundler makes of `import wasm from "chasles/chasles.wasm"`: an address, bytes or a module, by its loader.
import type { WasmSource } from "./index.js";

declare const wasm: WasmSource;
export default wasm;
