/** Wrong input: the message says what is wrong, where and why, in the words of the C++ library and the Python package. */
export class InvalidInput extends Error {
  constructor(message) {
    super(message);
    this.name = "InvalidInput";
  }
}

/** The memory of the instance is full. It answers on, and has room again when bodies are freed. */
export const outOfMemory = () =>
  new RangeError("chasles: out of memory: an instance has at most 4 GiB: free() what is not needed, or give less at once; this instance goes on");

/** The instance stopped within a call, and answers no more. `cause` says why; `load()` makes a new one. */
export class InstanceStopped extends Error {
  constructor(cause) {
    super(`chasles: this instance has stopped (${cause?.message ?? cause}); load() makes a new one`, { cause });
    this.name = "InstanceStopped";
  }
}
