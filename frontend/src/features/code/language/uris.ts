/** The root of the URIs of the project's files, which hides the real folder on the server. */
const PROJECT = 'file:///project/';
/** The root of Python outside of the project that can be read. */
const SOURCES = 'file:///library/';

const under = (root: string, path: string): string =>
  root + path.split('/').map(encodeURIComponent).join('/');

const below = (root: string, uri: string): string | null =>
  uri.startsWith(root) ? decodeURIComponent(uri.slice(root.length)) : null;

export const uriOf = (path: string): string => under(PROJECT, path);

export const pathOf = (uri: string): string | null => below(PROJECT, uri);

export const sourceUriOf = (path: string): string => under(SOURCES, path);

/**
 * Returns the path of a source outside of the project: the label of its folder (`packages`), and the path
 * below that; null for any other URI.
 */
export const sourceOf = (uri: string): string | null => below(SOURCES, uri);

/** The beginning of the path of the language server's own stubs: a version, and the folder `stdlib`. */
const STUBS = /^[0-9a-f]{40}\/(stdlib\/)?/;

/** Returns the path of a source as users know it: `rclpy/node.py`. */
export const sourceName = (path: string): string => path.slice(path.indexOf('/') + 1).replace(STUBS, '');

/** Returns the name under which lists show a file of the language server. */
export function nameOf(uri: string): string {
  const source = sourceOf(uri);
  return pathOf(uri) ?? (source === null ? uri : sourceName(source));
}
