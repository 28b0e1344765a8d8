import { ApiError } from './errors';

/** Returns the server's message together with its hint. */
export function reasonOf(error: Error): string {
  return error instanceof ApiError && error.hint ? `${error.message} ${error.hint}` : error.message;
}
