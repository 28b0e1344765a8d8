// One map for all files of tests: a module that a file before still loads would else hold a request class that
// this file's map does not know.
const KEY = Symbol.for('bt-studio/sent-bodies');

function recordBodies(): WeakMap<Request, unknown> {
  const bodies = new WeakMap<Request, unknown>();
  globalThis.Request = class extends Request {
    constructor(input: RequestInfo | URL, init?: RequestInit) {
      super(input, init);
      bodies.set(this, init?.body ?? undefined);
    }
  };
  Reflect.set(globalThis, KEY, bodies);
  return bodies;
}

/** The body of each request as it was given: a file of jsdom is lost in a request of Node. */
export const sentBodies =
  (Reflect.get(globalThis, KEY) as WeakMap<Request, unknown> | undefined) ?? recordBodies();
