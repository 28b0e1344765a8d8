import { ApiError } from '@/api/errors';
import { t } from '.';

/** Returns why a request failed, in the language of the page where it is the server that is away or new. */
export function serverReason(error: unknown): string {
  if (error instanceof ApiError && error.isRestarted) return t('frame:server.restarted');
  if (error instanceof ApiError && error.isOffline) return t('frame:server.unreachable');
  return error instanceof Error ? error.message : String(error);
}
