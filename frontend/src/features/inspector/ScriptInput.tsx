import { Text, Textarea } from '@mantine/core';
import { Suspense, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { isProblem, readScript } from '@/model/script';
import { scriptText } from '@/ui/scriptText';
import { lazyPart } from '@/ui/parts';
import type { ScriptEditorProps } from './ScriptEditor';

const focus = (field: HTMLTextAreaElement | null): void => {
  field?.focus();
};

const ScriptEditor = lazyPart(async () => (await import('./ScriptEditor')).ScriptEditor);

/**
 * An editor for blackboard scripts that checks while the user types. It is a plain field until the editor has
 * loaded.
 */
export function ScriptInput(props: ScriptEditorProps) {
  const { value, testId, labelledBy, label, isNew = false, onChange, onCancel } = props;
  const { t } = useTranslation();
  const problem = useMemo(() => {
    const facts = readScript(value);
    return value.trim() !== '' && isProblem(facts) ? scriptText(facts, t) : null;
  }, [value, t]);
  return (
    <div>
      <Suspense
        fallback={
          <Textarea
            size="xs"
            autosize
            aria-labelledby={labelledBy}
            aria-label={label}
            data-testid={testId}
            value={value}
            {...(isNew ? { ref: focus } : {})}
            onChange={(event) => {
              onChange(event.currentTarget.value);
            }}
            onKeyDown={({ key }) => {
              if (key === 'Escape' && value === '') onCancel?.();
            }}
          />
        }
      >
        <ScriptEditor {...props} />
      </Suspense>
      {problem ? (
        <Text size="xs" c="var(--bts-failure)" role="status" data-testid={`${testId}-error`}>
          {problem.message}: {problem.hint}
        </Text>
      ) : null}
    </div>
  );
}
