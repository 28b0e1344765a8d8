// Counts the statements of TypeScript, and the lines with code, for `python -m tests.tools.weight`.
//
// Reads paths from the standard input, one a line; writes `{path: [statements, lines]}`. Members of classes and
// types count as statements, as they are in Python. Comments, blank lines, imports and exports of other modules'
// names do not count.
import { readFileSync } from 'node:fs';
import process from 'node:process';

import ts from 'typescript';

const isLeftOut = (node) =>
  ts.isImportDeclaration(node) ||
  ts.isImportEqualsDeclaration(node) ||
  (ts.isExportDeclaration(node) && node.moduleSpecifier !== undefined) ||
  (ts.isJsxExpression(node) && node.expression === undefined) || // a comment between elements
  (node.kind >= ts.SyntaxKind.FirstJSDocNode && node.kind <= ts.SyntaxKind.LastJSDocNode);

const isCounted = (node) =>
  (ts.isStatement(node) && !ts.isBlock(node) && !ts.isEmptyStatement(node)) ||
  ts.isClassElement(node) ||
  ts.isTypeElement(node);

function weigh(path) {
  const source = ts.createSourceFile(path, readFileSync(path, 'utf8'), ts.ScriptTarget.Latest, true);
  const lines = new Set();
  let statements = 0;
  const visit = (node) => {
    if (isLeftOut(node) || node.kind === ts.SyntaxKind.EndOfFileToken) return;
    if (isCounted(node)) statements += 1;
    const children = node.getChildren(source);
    if (children.length > 0 || node.kind === ts.SyntaxKind.SyntaxList) return children.forEach(visit);
    const first = source.getLineAndCharacterOfPosition(node.getStart(source)).line;
    node
      .getText(source)
      .split('\n')
      .forEach((text, index) => {
        if (text.trim()) lines.add(first + index);
      });
  };
  source.getChildren(source).forEach(visit);
  return [statements, lines.size];
}

let input = '';
for await (const part of process.stdin.setEncoding('utf8')) input += part;
const paths = input.split('\n').filter(Boolean);
process.stdout.write(JSON.stringify(Object.fromEntries(paths.map((path) => [path, weigh(path)]))));
