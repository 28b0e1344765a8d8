/** Writes the types of the REST API, `src/generated/api.ts`, from the server's OpenAPI document. */
import { writeFileSync } from 'node:fs';
import { URL } from 'node:url';
import openapiTS, { astToString, COMMENT_HEADER } from 'openapi-typescript';
import ts from 'typescript';

const DOCUMENT = new URL('../../docs/reference/openapi.json', import.meta.url);
const BLOB = ts.factory.createTypeReferenceNode('Blob');

const types = await openapiTS(DOCUMENT, {
  // A field with a default may be left out of a request.
  defaultNonNullable: false,
  // Binary values are sent as they are.
  transform: (schema) => (schema.format === 'binary' ? BLOB : undefined),
});
writeFileSync('src/generated/api.ts', COMMENT_HEADER + astToString(types));
