import { LIMITS } from '@/generated/limits';
import { outside } from '../values';
import { tokenize, type Token } from './lexer';
import type { ScriptProblem, Span } from './problem';

export type { ScriptProblem } from './problem';

/**
 * Parses the script language of BehaviorTree.CPP. The grammar is that of `tree_gardener/script`: both are
 * tested on `tests/shared/scripts.json`.
 */

export interface ScriptName {
  readonly name: string;
  readonly span: Span;
}

export interface ScriptFacts {
  readonly read: readonly ScriptName[];
  readonly written: readonly ScriptName[];
}

const ASSIGNMENTS = new Set([':=', '=', '+=', '-=', '*=', '/=']);
const COMPARISONS = new Set(['==', '!=', '<', '>', '<=', '>=']);
const PREFIXES = new Set(['-', '~', '!']);
const BINARY = new Map([
  ...(['||'] as const).map((each) => [each, 3] as const),
  ...(['&&'] as const).map((each) => [each, 4] as const),
  ...(['|', '^'] as const).map((each) => [each, 6] as const),
  ...(['&'] as const).map((each) => [each, 7] as const),
  ...(['+', '-', '..'] as const).map((each) => [each, 8] as const),
  ...(['*', '/'] as const).map((each) => [each, 9] as const),
] as [string, number][]);
const [ASSIGNMENT, TERNARY, COMPARISON] = [1, 2, 5];
const MAX_NESTING = 250;

/** An operand: a name, or null for any other expression. */
type Operand = ScriptName | null;

class Refused extends Error {
  constructor(readonly problem: ScriptProblem) {
    super(problem.kind);
  }
}

class Parser {
  private index = 0;
  private nesting = 0;
  readonly names: ScriptName[] = [];
  readonly written: ScriptName[] = [];
  readonly created = new Set<ScriptName>();

  constructor(private readonly tokens: readonly Token[]) {}

  program(length: number): void {
    if (this.isDone()) throw new Refused({ kind: 'empty', values: {}, span: [0, length] });
    while (!this.isDone()) {
      this.expression(ASSIGNMENT);
      while (this.is(';')) this.index += 1;
    }
  }

  private get token(): Token {
    const token = this.tokens[this.index];
    if (!token) throw new Error('The end token stops every reader.');
    return token;
  }

  private isDone(): boolean {
    return this.token.kind === 'end';
  }

  private is(text: string): boolean {
    return this.token.kind === 'operator' && this.token.text === text;
  }

  private fail(kind: string, values: Record<string, string> = {}): never {
    throw new Refused({ kind, values, span: this.token.span });
  }

  /** Parses an expression within another one, other than the right side of an operator. */
  private nested(level: number): Operand {
    this.nesting += 1;
    if (this.nesting > MAX_NESTING) this.fail('nested');
    const inner = this.expression(level);
    this.nesting -= 1;
    return inner;
  }

  private expression(level: number): Operand {
    let left = this.operand();
    for (;;) {
      const extended = this.extend(left, level);
      if (extended === undefined) return left;
      left = extended;
    }
  }

  /** Parses the next operator; undefined if it binds less tightly than `level`. */
  private extend(left: Operand, level: number): Operand | undefined {
    const operator = this.token.kind === 'operator' ? this.token.text : '';
    const binding = BINARY.get(operator);
    if (binding !== undefined && binding >= level) {
      this.index += 1;
      this.expression(binding + 1);
      return null;
    }
    if (COMPARISONS.has(operator) && level <= COMPARISON) {
      while (this.token.kind === 'operator' && COMPARISONS.has(this.token.text)) {
        this.index += 1;
        this.expression(COMPARISON + 1);
      }
      return null;
    }
    if (operator === '?' && level <= TERNARY) return this.conditional();
    if (ASSIGNMENTS.has(operator) && level <= ASSIGNMENT) return this.assignment(left, operator);
    return undefined;
  }

  private assignment(target: Operand, operator: string): null {
    this.index += 1;
    if (target) {
      this.written.push(target);
      if (operator === ':=') this.created.add(target);
    }
    this.nested(ASSIGNMENT);
    return null;
  }

  private conditional(): null {
    this.index += 1;
    this.nested(ASSIGNMENT);
    if (!this.is(':')) this.fail('colon');
    this.index += 1;
    this.nested(TERNARY);
    return null;
  }

  private operand(): Operand {
    const { kind, text, span } = this.token;
    if (kind === 'operator' && PREFIXES.has(text)) return this.prefixed();
    if (kind === 'operator' && text === '(') return this.group();
    if (kind === 'end') this.fail('valueAtEnd');
    if (kind === 'operator') {
      const isAssigning = ASSIGNMENTS.has(text) || COMPARISONS.has(text);
      this.fail(isAssigning ? 'valueBeforeAssignment' : 'valueBefore', { text });
    }
    if (kind === 'real' && outside('double', text)) this.fail('outside', { text });
    this.index += 1;
    if (kind !== 'name' || text === 'true' || text === 'false') return null;
    const name = { name: text, span };
    this.names.push(name);
    return name;
  }

  private prefixed(): null {
    let count = 0;
    while (this.token.kind === 'operator' && PREFIXES.has(this.token.text)) {
      this.index += 1;
      count += 1;
    }
    if (count > MAX_NESTING) this.fail('prefixes');
    this.operand();
    return null;
  }

  private group(): Operand {
    this.index += 1;
    const inner = this.nested(ASSIGNMENT);
    if (!this.is(')')) this.fail('parenthesis');
    this.index += 1;
    return inner;
  }
}

/** Returns the names that a script reads and writes, or its syntax error. */
export function readScript(text: string): ScriptFacts | ScriptProblem {
  const limit = LIMITS.script_characters;
  // Code points, as Python counts; two units of UTF-16 are one character.
  if (text.length > limit && [...text].length > limit) {
    return { kind: 'tooLong', values: { limit: String(limit) }, span: [0, 0] };
  }
  const tokens = tokenize(text);
  if (!Array.isArray(tokens)) return tokens as ScriptProblem;
  const parser = new Parser(tokens as readonly Token[]);
  try {
    parser.program(text.length);
  } catch (error) {
    if (error instanceof Refused) return error.problem;
    throw error;
  }
  return {
    read: parser.names.filter((name) => !parser.created.has(name)),
    written: parser.written,
  };
}

export const isProblem = (facts: ScriptFacts | ScriptProblem): facts is ScriptProblem => 'kind' in facts;
