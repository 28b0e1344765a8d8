import { createElement, lazy, useState, type ComponentType, type LazyExoticComponent } from 'react';

/** Thrown when a part of the page or its style sheet could not be loaded in several attempts. */
export class PartMissing extends Error {
  override readonly name = 'PartMissing';
}

/** The pauses between attempts: a server that is busy or restarting usually answers again within seconds. */
const AGAIN_AFTER_MS = [400, 1500, 4000] as const;

const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

/** Retries a request until it succeeds or the attempts are used up; then it throws the last error. */
async function insist<T>(ask: () => Promise<T>): Promise<T> {
  for (const wait of AGAIN_AFTER_MS) {
    try {
      return await ask();
    } catch {
      await pause(wait);
    }
  }
  return ask();
}

/** Returns whether a style sheet failed to load: a browser gives such a sheet no rules. */
function isMissing({ sheet }: HTMLLinkElement): boolean {
  try {
    return !sheet || sheet.cssRules.length === 0;
  } catch {
    return true;
  }
}

/** Requests a style sheet again, and replaces the one that failed or is still loading. */
function fetchAnew(link: HTMLLinkElement): Promise<void> {
  const next = link.cloneNode() as HTMLLinkElement;
  return new Promise((done, fail) => {
    next.onload = () => {
      link.remove();
      done();
    };
    next.onerror = () => {
      next.remove();
      fail(new PartMissing(`The style sheet ${new URL(link.href).pathname} did not come.`));
    };
    link.after(next);
  });
}

/**
 * Waits for all style sheets of the page. A browser requests each only once, and shows the page without a
 * sheet that fails; the loader of lazy parts treats a requested sheet as loaded. Failed sheets are therefore
 * requested again.
 */
export async function stylesArrive(page: Document = document): Promise<void> {
  const links = [...page.querySelectorAll<HTMLLinkElement>('link[rel=stylesheet]')];
  await Promise.all(links.filter(isMissing).map((link) => insist(() => fetchAnew(link))));
}

/** Loads a part of the page with its style sheets, with retries. */
export async function loadPart<T>(load: () => Promise<T>): Promise<T> {
  try {
    const part = await insist(load);
    await stylesArrive();
    return part;
  } catch (error) {
    if (error instanceof PartMissing) throw error;
    throw new PartMissing(error instanceof Error ? error.message : String(error));
  }
}

/** Returns a component that is loaded when it is first shown. */
export function lazyPart<Props>(
  load: () => Promise<ComponentType<Props>>,
): LazyExoticComponent<ComponentType<Props>> {
  return lazy(async () => ({ default: await loadPart(load) }));
}

/**
 * Returns a component that is loaded when it is first shown, and a function that loads it before. One that is
 * there is shown at once: after a placeholder, React waits 300 ms until it shows what has arrived.
 */
export function preparedPart<Props extends object>(
  load: () => Promise<ComponentType<Props>>,
): [ComponentType<Props>, () => Promise<void>] {
  let there: ComponentType<Props> | null = null;
  const prepare = async () => {
    there = await loadPart(load);
    return there;
  };
  const Awaited = lazy(async () => ({ default: await prepare() }));
  function Part(props: Props) {
    const [Shown] = useState(() => there ?? (Awaited as ComponentType<Props>));
    return createElement(Shown, props);
  }
  return [Part, async () => void (await prepare())];
}
