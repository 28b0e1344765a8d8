/** A text of the user, with the state of the tree at the last synchronization. */
export interface CachedXml {
  readonly text: string;
  readonly agreed: { readonly text: string; readonly ids: readonly string[]; readonly diagram: string };
}

const key = (projectId: string, treeId: string) => `bts.xml.${projectId}.${treeId}`;

/**
 * Stores a text in the browser: unparsable text and comments would be lost otherwise, since a tree cannot
 * hold them.
 */
export function keepXml(projectId: string, treeId: string, kept: CachedXml): void {
  try {
    localStorage.setItem(key(projectId, treeId), JSON.stringify(kept));
  } catch {
    // The browser's storage is full: the text is lost when its panel closes.
  }
}

export function cachedXml(projectId: string, treeId: string): CachedXml | null {
  const json = localStorage.getItem(key(projectId, treeId));
  if (json === null) return null;
  try {
    const kept = JSON.parse(json) as CachedXml;
    return typeof kept.text === 'string' && typeof kept.agreed.text === 'string' ? kept : null;
  } catch {
    return null;
  }
}

export function forgetXml(projectId: string, treeId: string): void {
  localStorage.removeItem(key(projectId, treeId));
}
