import { attributesOf, DESCRIPTION, OFFERED } from '../treeAttributes';
import type { Recipe } from './core';

function setAttribute(name: string, text: string | null): Recipe {
  return (draft) => {
    const { [name]: _before, ...others } = attributesOf(draft);
    const attributes = text === null ? others : { ...others, [name]: text };
    if (Object.keys(attributes).length > 0) draft.attributes = attributes;
    else delete draft.attributes;
  };
}

/** Sets what the tree says of itself; a blank text removes it. */
export const setDescription = (text: string): Recipe =>
  setAttribute(DESCRIPTION, text.trim() === '' ? null : text);

/** Offers the tree to other projects in their library, or no longer. */
export const setOffered = (offered: boolean): Recipe => setAttribute(OFFERED, offered ? '1' : null);
