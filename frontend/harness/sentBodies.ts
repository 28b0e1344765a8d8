/** The body of each request as it was given: a file of jsdom is lost in a request of Node. */
export const sentBodies = new WeakMap<Request, unknown>();

globalThis.Request = class extends Request {
  constructor(input: RequestInfo | URL, init?: RequestInit) {
    super(input, init);
    sentBodies.set(this, init?.body ?? undefined);
  }
};
