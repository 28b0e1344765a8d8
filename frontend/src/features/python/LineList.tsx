import { ActionIcon, Button, Checkbox, NumberInput, TextInput } from '@mantine/core';
import { IconChevronDown, IconChevronRight, IconTrash } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { openFile } from '@/store/project/navigation';
import {
  changeLine,
  EXCEPTIONS,
  isOfLaunchNode,
  removeAllLines,
  toggleException,
  toggleLine,
  useLines,
  type LineBreakpoint,
} from '@/store/python/lines';
import { usePython } from '@/store/python/stop';
import classes from './python.module.css';

/** The breakpoints in Python code, and the exceptions at which a program stops. */
export function LineList() {
  const { t } = useTranslation('debug');
  const list = useLines((state) => state.list);
  const exceptions = useLines((state) => state.exceptions);
  return (
    <section className={classes['column']} aria-label={t('python.title')}>
      <div className={classes['line']}>
        <h2>{t('python.title')}</h2>
        {list.length > 0 && (
          <Button size="compact-xs" variant="default" onClick={removeAllLines}>
            {t('removeAll')}
          </Button>
        )}
      </div>
      {list.length === 0 && <p className={classes['note']}>{t('python.none')}</p>}
      <ul className={classes['list']}>
        {list.map((each) => (
          <Row key={`${each.path}:${each.line}`} breakpoint={each} />
        ))}
      </ul>
      {EXCEPTIONS.map((each) => (
        <Checkbox
          key={each}
          size="md"
          label={t(`python.exception.${each}`)}
          checked={exceptions.includes(each)}
          data-testid={`exception-${each}`}
          onChange={() => toggleException(each)}
        />
      ))}
    </section>
  );
}

function Row({ breakpoint: each }: { readonly breakpoint: LineBreakpoint }) {
  const { t } = useTranslation('debug');
  const { path, line, condition, hits, log } = each;
  const refused = usePython(({ problems }) => problems[`${path}:${line}`]);
  const problem = isOfLaunchNode(path) ? t('python.launchNode') : refused;
  const [isOpen, setOpen] = useState(false);
  const name = `${path}:${line}`;
  const change = (next: Partial<LineBreakpoint>) => changeLine(path, line, next);
  const words = [
    condition && t('ifCondition', { condition }),
    hits > 1 && t('fromHit', { hits }),
    log && t('logs', { text: log }),
  ];
  return (
    <li className={classes['variable']} data-testid={`line-${name}`}>
      <div className={classes['line']}>
        <Checkbox
          size="md"
          aria-label={t('isOn', { name })}
          checked={each.on}
          onChange={({ currentTarget: { checked } }) => change({ on: checked })}
        />
        <button
          type="button"
          className={classes['place']}
          title={t('python.show')}
          onClick={() => openFile(path, line)}
        >
          {name}
        </button>
        <span className={classes['value']}>{words.filter(Boolean).join(' · ')}</span>
        <ActionIcon
          size={24}
          aria-label={t('edit', { name })}
          aria-expanded={isOpen}
          onClick={() => setOpen(!isOpen)}
        >
          {isOpen ? <IconChevronDown size={15} /> : <IconChevronRight size={15} />}
        </ActionIcon>
        <ActionIcon size={24} aria-label={t('removeOf', { name })} onClick={() => toggleLine(path, line)}>
          <IconTrash size={15} />
        </ActionIcon>
      </div>
      {problem && <p className={classes['note']}>{problem}</p>}
      {isOpen && (
        <div className={classes['fields']}>
          <Line
            label={t('python.condition')}
            placeholder="self.n > 3"
            value={condition}
            onDone={(next) => change({ condition: next })}
          />
          <NumberInput
            size="xs"
            label={t('field.hits')}
            value={hits}
            min={1}
            max={1_000_000}
            allowDecimal={false}
            clampBehavior="strict"
            onChange={(value) => typeof value === 'number' && value >= 1 && change({ hits: value })}
          />
          <Line
            label={t('field.log')}
            placeholder="n = {self.n}"
            value={log}
            onDone={(next) => change({ log: next })}
          />
        </div>
      )}
    </li>
  );
}

interface LineProps {
  readonly label: string;
  readonly placeholder: string;
  readonly value: string;
  readonly onDone: (value: string) => void;
}

/** A line of text that takes effect when it is left, or by Enter. */
function Line({ label, placeholder, value, onDone }: LineProps) {
  const [text, setText] = useState(value);
  const done = () => text.trim() !== value && onDone(text.trim());
  return (
    <TextInput
      size="xs"
      label={label}
      placeholder={placeholder}
      value={text}
      maxLength={1000}
      spellCheck={false}
      onChange={({ currentTarget }) => setText(currentTarget.value)}
      onBlur={done}
      onKeyDown={({ key }) => key === 'Enter' && done()}
    />
  );
}
