/** The root of the URIs of the project's files, which hides the real folder on the server. */
const PROJECT = 'file:///project/';
const LIBRARY = 'file:///library/';

export const uriOf = (path: string): string => PROJECT + path.split('/').map(encodeURIComponent).join('/');

export const pathOf = (uri: string): string | null =>
  uri.startsWith(PROJECT) ? decodeURIComponent(uri.slice(PROJECT.length)) : null;

/** Returns the name of the library module that a URI refers to; null for any other URI. */
export const libraryOf = (uri: string): string | null =>
  uri.startsWith(LIBRARY) ? decodeURIComponent(uri.slice(LIBRARY.length)) : null;
