import type { TFunction } from 'i18next';
import type { DiagramNode } from '@/model/diagram';
import { BLOCK, portLines, type PortLine } from '@/model/measure';
import { readPortText } from '@/model/ports';
import type { NodeSpec } from '@/model/vocabulary';
import type { PortMark, PortMarks } from '@/store/run/portMarks';
import classes from './Block.module.css';

function valueClass(line: PortLine): string {
  if (line.value === null) return line.required && line.default === null ? 'portMissing' : 'portDefault';
  const kind = readPortText(line.value).kind;
  if (kind === 'broken') return 'portMissing';
  return kind === 'key' || kind === 'same-name' ? 'portKey' : 'portLiteral';
}

const ARROWS = { input: '', output: '→', inout: '⇄' } as const;

const shownValue = (line: PortLine, t: TFunction<'canvas'>): string =>
  line.value ?? line.default ?? (line.required ? t('port.missing') : '—');

interface BlockPortsProps {
  readonly node: DiagramNode;
  readonly spec: NodeSpec | undefined;
  readonly marks: PortMarks;
  readonly t: TFunction<'canvas'>;
}

/** What the pointer tells of a value: the whole text, and how it differs from the saved one. */
function titleOf(line: PortLine, mark: PortMark | undefined, t: TFunction<'canvas'>): string | undefined {
  if (!mark) return line.value ?? undefined;
  const saved = mark.saved ?? line.default ?? t('port.noValue');
  return t(`port.live.${mark.state}`, { value: line.value ?? line.default ?? '', saved });
}

/** The block's ports with their values, as many as fit. */
export function BlockPorts({ node, spec, marks, t }: BlockPortsProps) {
  const lines = portLines(node, spec);
  if (lines.length === 0) return null;
  const more = lines.length - BLOCK.maxPorts;
  return (
    <ul className={classes['ports']}>
      {lines.slice(0, BLOCK.maxPorts).map((line) => {
        const value = shownValue(line, t);
        const mark = marks.get(line.name);
        return (
          <li key={line.name} className={classes['port']}>
            <span className={classes['portName']}>
              {ARROWS[line.direction]} {line.name}
            </span>
            <span
              className={classes[valueClass(line)]}
              title={titleOf(line, mark, t)}
              data-live={mark?.state}
              data-long={value.length > BLOCK.valueLetters || undefined}
            >
              {value}
            </span>
          </li>
        );
      })}
      {more > 0 && <li className={classes['portMore']}>{t('port.more', { count: more })}</li>}
    </ul>
  );
}
