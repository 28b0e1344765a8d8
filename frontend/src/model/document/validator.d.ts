/** A schema as a function; `validators.ts` compiles it when the page is built. */
declare module '*.schema.json?validator' {
  import type { ErrorObject } from 'ajv';

  export const validate: {
    (value: unknown): boolean;
    errors?: readonly ErrorObject<string, Record<string, unknown>>[] | null;
  };
}
