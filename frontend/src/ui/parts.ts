import { lazy, type ComponentType, type LazyExoticComponent } from 'react';

/** A part of the page, or its style, did not come, however often it was asked for. */
export class PartMissing extends Error {
  override readonly name = 'PartMissing';
}

/** A server under load, or one that is being restarted, answers again within seconds. */
const AGAIN_AFTER_MS = [400, 1500, 4000] as const;

const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

/** Asks until it comes; the last refusal is the answer. */
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

/** Whether it has not come: what a browser could not fetch is to it a style sheet without rules. */
function isMissing({ sheet }: HTMLLinkElement): boolean {
  try {
    return !sheet || sheet.cssRules.length === 0;
  } catch {
    return true;
  }
}

/** Puts a style sheet in the place of one that did not come, or is still coming. */
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
 * Waits until the page has every style sheet that it names. A browser asks once for a style sheet,
 * and then shows the page without it; and the loader of lazy parts takes one for loaded once it has
 * asked for it.
 */
export async function stylesArrive(page: Document = document): Promise<void> {
  const links = [...page.querySelectorAll<HTMLLinkElement>('link[rel=stylesheet]')];
  await Promise.all(links.filter(isMissing).map((link) => insist(() => fetchAnew(link))));
}

/** Loads a part of the page with its style, and asks again when it does not come. */
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

/** A component that is loaded when it is first shown. */
export function lazyPart<Props>(
  load: () => Promise<ComponentType<Props>>,
): LazyExoticComponent<ComponentType<Props>> {
  return lazy(async () => ({ default: await loadPart(load) }));
}
