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

/** Sets the description of the tree; a blank text removes it. */
export const setDescription = (text: string): Recipe =>
  setAttribute(DESCRIPTION, text.trim() === '' ? null : text);

/** Sets whether the libraries of other projects offer the tree. */
export const setOffered = (offered: boolean): Recipe => setAttribute(OFFERED, offered ? '1' : null);
