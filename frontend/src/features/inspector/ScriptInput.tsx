import { Text, Textarea } from '@mantine/core';
import { Suspense, useCallback, useLayoutEffect, useMemo, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { isProblem, readScript } from '@/model/script';
import { scriptText } from '@/ui/scriptText';
import { lazyPart } from '@/ui/parts';
import type { ScriptEditorProps } from './ScriptEditor';

const ScriptEditor = lazyPart(async () => (await import('./ScriptEditor')).ScriptEditor);

interface PlainFieldProps extends ScriptEditorProps {
  /** Called when the editor replaces the field, with the place of the caret; null if it was elsewhere. */
  readonly onReplaced: (caret: number | null) => void;
}

function PlainField(props: PlainFieldProps) {
  const { value, testId, labelledBy, label, isNew = false, onChange, onCancel, onReplaced } = props;
  const field = useRef<HTMLTextAreaElement>(null);
  useLayoutEffect(() => {
    const present = field.current;
    if (isNew) present?.focus();
    return () => {
      onReplaced(present !== null && document.activeElement === present ? present.selectionStart : null);
    };
  }, [isNew, onReplaced]);
  return (
    <Textarea
      ref={field}
      size="xs"
      autosize
      aria-labelledby={labelledBy}
      aria-label={label}
      data-testid={testId}
      value={value}
      onChange={(event) => {
        onChange(event.currentTarget.value);
      }}
      onKeyDown={({ key }) => {
        if (key === 'Escape' && value === '') onCancel?.();
      }}
    />
  );
}

/**
 * An editor for blackboard scripts that checks while the user types. It is a plain field until the editor has
 * loaded, which then takes over the caret.
 */
export function ScriptInput(props: ScriptEditorProps) {
  const { value, testId } = props;
  const { t } = useTranslation();
  const caret = useRef<number | null>(null);
  const keepCaret = useCallback((at: number | null) => {
    caret.current = at;
  }, []);
  const takeCaret = useCallback(() => caret.current, []);
  const problem = useMemo(() => {
    const facts = readScript(value);
    return value.trim() !== '' && isProblem(facts) ? scriptText(facts, t) : null;
  }, [value, t]);
  return (
    <div>
      <Suspense fallback={<PlainField {...props} onReplaced={keepCaret} />}>
        <ScriptEditor {...props} takeCaret={takeCaret} />
      </Suspense>
      {problem ? (
        <Text size="xs" c="var(--bts-failure)" role="status" data-testid={`${testId}-error`}>
          {problem.message}: {problem.hint}
        </Text>
      ) : null}
    </div>
  );
}
