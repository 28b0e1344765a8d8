/** The server's URIs for the project's files; their folder on its machine stays hidden. */
const PROJECT = 'file:///project/';
const LIBRARY = 'file:///library/';

export const uriOf = (path: string): string => PROJECT + path.split('/').map(encodeURIComponent).join('/');

export const pathOf = (uri: string): string | null =>
  uri.startsWith(PROJECT) ? decodeURIComponent(uri.slice(PROJECT.length)) : null;

/** The module of a library that an address names, for people. */
export const libraryOf = (uri: string): string | null =>
  uri.startsWith(LIBRARY) ? decodeURIComponent(uri.slice(LIBRARY.length)) : null;
