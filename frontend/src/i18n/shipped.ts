import i18next from 'i18next';
import type { Choice } from '@/model/choices';

interface Described {
  readonly doc?: string;
  readonly ports?: Readonly<Record<string, string>>;
}

/**
 * Returns a text of a built-in node, or of a shipped action or tree, in the current language. A text that the user changed is shown
 * as it is.
 */
function shipped(type: string, text: string, pick: (described: Described) => string | undefined): string {
  if (text === '') return text;
  const ours = (language: string) =>
    i18next.getResource(language, 'shipped', type) as readonly Described[] | undefined;
  const at = (ours('en') ?? []).findIndex((each) => pick(each) === text);
  const found = at < 0 ? undefined : ours(i18next.language.startsWith('es') ? 'es' : 'en')?.[at];
  return (found && pick(found)) ?? text;
}

export const shippedDoc = (type: string, text: string): string => shipped(type, text, ({ doc }) => doc);

/** Returns the description of a choice of the palette: the tree's own, or that of its type. */
export const shippedChoice = ({ kind, spec }: Choice): string =>
  shippedDoc(kind.tree ?? spec.type, spec.summary);

export const shippedPort = (type: string, port: string, text: string): string =>
  shipped(type, text, ({ ports }) => ports?.[port]);
