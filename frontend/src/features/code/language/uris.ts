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

/** The path of a source outside of the project: a label of its folder (`packages`), and the path below that. */
export const sourceOf = (uri: string): string | null => below(SOURCES, uri);

/** The folder of the language server's own stubs has a version, and all of them are in `stdlib`. */
const STUBS = /^[0-9a-f]{40}\/(stdlib\/)?/;

/** The path of a source as a reader knows it: `rclpy/node.py`. */
export const sourceName = (path: string): string => path.slice(path.indexOf('/') + 1).replace(STUBS, '');

/** The name of any file of the language server, for lists. */
export function nameOf(uri: string): string {
  const source = sourceOf(uri);
  return pathOf(uri) ?? (source === null ? uri : sourceName(source));
}
