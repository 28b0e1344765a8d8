import type { Conflict, Diagnostic, Problem } from './types';

/** A failed request: the server refused it, or could not be reached (`isOffline`). */
export class ApiError extends Error {
  override readonly name = 'ApiError';

  constructor(readonly problem: Problem) {
    super(problem.detail ?? problem.title);
  }

  get code(): string {
    return this.problem.code;
  }

  get status(): number {
    return this.problem.status;
  }

  get hint(): string {
    return this.problem.hint ?? '';
  }

  get diagnostics(): Diagnostic[] {
    return this.problem.diagnostics ?? [];
  }

  get conflicts(): Conflict[] {
    return this.problem.conflicts ?? [];
  }

  /** Returns whether no answer came: the same request may succeed later. */
  get isOffline(): boolean {
    return this.problem.status === 0;
  }

  /** Returns whether the server does not know this browser since it was started again: its link is new. */
  get isRestarted(): boolean {
    return this.problem.code === 'link_required';
  }
}

export function offlineError(cause: unknown): ApiError {
  const detail = cause instanceof Error ? cause.message : String(cause);
  return new ApiError({ title: 'The server cannot be reached', status: 0, code: 'offline', detail });
}

/** Reads the body of a refusal; a body that is not problem+json becomes a problem of the same shape. */
export async function errorFrom(response: Response): Promise<ApiError> {
  const fallback: Problem = {
    title: response.statusText || `HTTP ${response.status}`,
    status: response.status,
    code: `http_${response.status}`,
  };
  if (!response.headers.get('content-type')?.includes('json')) return new ApiError(fallback);
  try {
    const body = (await response.json()) as Partial<Problem>;
    return new ApiError({ ...fallback, ...body });
  } catch {
    return new ApiError(fallback);
  }
}
