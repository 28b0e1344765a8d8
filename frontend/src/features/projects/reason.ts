import { ApiError } from '@/api/errors';

/** What the server said was wrong, and what to do about it. */
export function reasonOf(error: Error): string {
  return error instanceof ApiError && error.hint ? `${error.message} ${error.hint}` : error.message;
}
