import Ajv2020 from 'ajv/dist/2020.js';
import standaloneCode from 'ajv/dist/standalone/index.js';
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const QUERY = '?validator';
/** Without `.json` at its end, so that nothing takes the module for JSON. */
const MODULE = '\0validator:';

interface Discriminated {
  type?: 'object';
  discriminator: { propertyName: string; mapping?: Record<string, string> };
  kinds?: string[];
}

/**
 * Compiles `x.schema.json?validator` to a module with a function `validate`. So the page has neither a
 * compiler of schemas nor a need for `eval`, which its content security policy forbids.
 */
export function validators(): Plugin {
  return {
    name: 'bt-studio-validators',
    enforce: 'pre',
    async resolveId(source, importer) {
      if (!source.endsWith(QUERY)) return null;
      const found = await this.resolve(source.slice(0, -QUERY.length), importer, { skipSelf: true });
      return found && MODULE + found.id.replace(/\.json$/, '');
    },
    load(id) {
      if (!id.startsWith(MODULE)) return null;
      const path = `${id.slice(MODULE.length)}.json`;
      this.addWatchFile(path);
      return compiled(readFileSync(path, 'utf8'));
    },
  };
}

function compiled(text: string): string {
  const ajv = new Ajv2020({
    code: { source: true, esm: true },
    allErrors: true,
    // The schema beside an error tells what else was possible there.
    verbose: true,
    messages: false,
    discriminator: true,
    strict: true,
    logger: false,
    // Lengths and patterns as JavaScript counts, so that the code needs no part of ajv.
    unicode: false,
    unicodeRegExp: false,
  });
  ajv.addKeyword({ keyword: 'kinds', schemaType: 'array' });
  const schema: unknown = JSON.parse(text, (_, part: unknown) =>
    isDiscriminated(part) ? named(part) : part,
  );
  ajv.addSchema({ $id: 'document', ...Object(schema) });
  const code = standaloneCode(ajv, { validate: 'document' });
  if (code.includes('require(')) throw new Error('The validator is not whole: it needs a part of ajv.');
  return code;
}

const isDiscriminated = (part: unknown): part is Discriminated =>
  typeof part === 'object' && part !== null && 'discriminator' in part && !('type' in part);

/** Names the kinds by a keyword of our own: ajv finds them by their constants, and takes no mapping. */
const named = ({ discriminator, ...rest }: Discriminated): Discriminated => ({
  ...rest,
  // Its `discriminator` is about objects alone, and lets all other values pass.
  type: 'object',
  discriminator: { propertyName: discriminator.propertyName },
  kinds: Object.keys(discriminator.mapping ?? {}),
});
