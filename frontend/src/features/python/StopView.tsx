import { ActionIcon, Button } from '@mantine/core';
import { IconPlus, IconTrash } from '@tabler/icons-react';
import { useEffect, useId, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { TreeNode } from '@/generated/messages';
import { nameOf } from '@/features/why/sentence';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { useSessionStore } from '@/store/session/store';
import { toggleWatch, useLines } from '@/store/python/lines';
import {
  chooseFrame,
  completionsOf,
  evaluate,
  scopesOf,
  shownFrame,
  usePython,
  type Stop,
  type Variable,
} from '@/store/python/stop';
import { VariableRow } from './VariableRow';
import classes from './python.module.css';

/** The stop of a program at a line: its stack, the variables of a frame, watches, and a field to evaluate. */
export function StopView() {
  const { t } = useTranslation('debug');
  const stop = usePython((state) => state.stop);
  const refusal = usePython((state) => state.refusal);
  return (
    <>
      {refusal && (
        <p className={classes['refusal']} role="alert" data-testid="python-refusal">
          {refusal}
        </p>
      )}
      {stop && (
        <section className={classes['stop']} aria-label={t('python.held')} data-testid="python-stop">
          <Stack stop={stop} />
          <Scopes key={`${stop.version} ${stop.frame}`} />
          <div className={classes['column']}>
            <Watches version={`${stop.version} ${stop.frame}`} />
            <Evaluate />
          </div>
        </section>
      )}
    </>
  );
}

function Stack({ stop }: { readonly stop: Stop }) {
  const { t } = useTranslation('debug');
  return (
    <div className={classes['column']}>
      <h2>{t('python.stack')}</h2>
      <ol className={classes['list']}>
        <TreePath />
        {stop.frames.map(({ id, name, path, line }, at) => (
          <li key={id}>
            <button
              type="button"
              className={classes['frame']}
              aria-current={at === stop.frame}
              onClick={() => {
                chooseFrame(at);
                if (path) openFile(path, line);
              }}
            >
              {name} <span className={classes['note']}>{path ? `${path}:${line}` : t('python.outside')}</span>
            </button>
          </li>
        ))}
      </ol>
    </div>
  );
}

/** The blocks that led to the held code, before the calls within it; a press shows the last one. */
function TreePath() {
  const uid = useSessionStore(({ heldInPython }) => heldInPython?.uid ?? 0);
  const tree = useSessionStore((state) => state.tree);
  const path: TreeNode[] = [];
  for (let node = tree[uid - 1]; node; node = tree[node.parent - 1]) path.unshift(node);
  const held = path.at(-1);
  if (!held) return null;
  return (
    <li>
      <button
        type="button"
        className={classes['frame']}
        data-testid="python-tree-path"
        onClick={() => useProjectStore.getState().reveal(held.tree_id, held.node_id)}
      >
        {path.map(nameOf).join(' › ')}
      </button>
    </li>
  );
}

function Scopes() {
  const { t } = useTranslation('debug');
  const frame = usePython((state) => shownFrame(state)?.id);
  const [scopes, setScopes] = useState<readonly Variable[]>([]);
  useEffect(() => {
    if (frame === undefined) return;
    let isGone = false;
    scopesOf(frame).then(
      (found) => isGone || setScopes(found),
      () => undefined, // the program has continued meanwhile
    );
    return () => {
      isGone = true;
    };
  }, [frame]);
  return (
    <div className={classes['column']}>
      <h2>{t('python.variables')}</h2>
      <ul className={classes['list']}>
        {scopes.map((each, at) => (
          <VariableRow key={each.name} variable={each} isOpen={at === 0} />
        ))}
      </ul>
    </div>
  );
}

function Watches({ version }: { readonly version: string }) {
  const { t } = useTranslation('debug');
  const watches = useLines((state) => state.watches);
  return (
    <>
      {watches.length > 0 && <h2>{t('python.watches')}</h2>}
      <ul className={classes['list']}>
        {watches.map((each) => (
          <li key={each} className={classes['line']}>
            <Watch key={version} expression={each} />
            <ActionIcon
              size={24}
              aria-label={t('python.unwatch', { name: each })}
              onClick={() => toggleWatch(each)}
            >
              <IconTrash size={14} />
            </ActionIcon>
          </li>
        ))}
      </ul>
    </>
  );
}

function Watch({ expression }: { readonly expression: string }) {
  const { t } = useTranslation('debug');
  const [found, setFound] = useState<Variable | null>(null);
  const [failure, setFailure] = useState('');
  useEffect(() => {
    let isGone = false;
    evaluate(expression, 'watch').then(
      (value) => isGone || setFound(value),
      (error: Error) => isGone || setFailure(lastLine(error.message)),
    );
    return () => {
      isGone = true;
    };
  }, [expression]);
  if (found)
    return (
      <ul className={classes['list']}>
        <VariableRow variable={found} />
      </ul>
    );
  return (
    <span className={classes['variable']}>
      <span className={classes['name']}>{expression}</span>{' '}
      <span className={classes['note']}>{failure || t('python.asked')}</span>
    </span>
  );
}

/** Returns the last line of a traceback, which names the exception. */
const lastLine = (text: string) => text.trimEnd().split('\n').at(-1) ?? '';

function Evaluate() {
  const { t } = useTranslation('debug');
  const list = useId();
  const [text, setText] = useState('');
  const [offered, setOffered] = useState<readonly string[]>([]);
  const [answer, setAnswer] = useState<Variable | null>(null);
  const [failure, setFailure] = useState('');
  const ask = async () => {
    if (!text.trim()) return;
    try {
      setAnswer(await evaluate(text, 'repl'));
      setFailure('');
    } catch (error) {
      setAnswer(null);
      setFailure(error instanceof Error ? lastLine(error.message) : String(error));
    }
  };
  return (
    <form
      className={classes['evaluate']}
      onSubmit={(event) => {
        event.preventDefault();
        void ask();
      }}
    >
      <h2>{t('python.evaluate')}</h2>
      <div className={classes['line']}>
        <input
          className={classes['field']}
          aria-label={t('python.expression')}
          placeholder={t('python.example')}
          value={text}
          list={list}
          autoComplete="off"
          spellCheck={false}
          data-testid="python-expression"
          onChange={({ currentTarget: { value } }) => {
            setText(value);
            completionsOf(value).then(setOffered, () => setOffered([]));
          }}
        />
        <datalist id={list}>
          {offered.map((each) => (
            <option key={each} value={each} />
          ))}
        </datalist>
        <Button type="submit" size="compact-sm" variant="default" data-testid="python-evaluate">
          {t('python.do')}
        </Button>
        <ActionIcon
          size={24}
          aria-label={t('python.watch')}
          disabled={!text.trim()}
          onClick={() => toggleWatch(text.trim())}
        >
          <IconPlus size={15} />
        </ActionIcon>
      </div>
      <div role="status" data-testid="python-answer">
        {answer && (
          <ul className={classes['list']}>
            <VariableRow key={answer.reference} variable={answer} />
          </ul>
        )}
        {failure && <p className={classes['refusal']}>{failure}</p>}
      </div>
      <p className={classes['note']}>{t('python.byHand')}</p>
    </form>
  );
}
