import { Button, Group, List, Modal, Stack, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { AppliedNode } from '@/generated/messages';
import { useApplyQuestion } from '@/store/run/apply';

/** The question before a changed tree halts something that runs: what happens to which blocks. */
export function ApplyDialog() {
  const { t } = useTranslation('run');
  const { name, plan, answer } = useApplyQuestion();
  const refuse = () => answer(false);
  return (
    <Modal
      opened={plan !== null}
      onClose={refuse}
      title={t(name === 'apply' ? 'apply.title' : 'apply.runOnTitle')}
      centered
    >
      {plan ? (
        <Stack gap="sm" data-testid="apply-plan">
          <Text size="sm">{t('apply.kept', { count: plan.kept })}</Text>
          <Nodes title={t('apply.halted')} nodes={plan.halted} />
          <Nodes title={t('apply.renewed')} nodes={plan.renewed} />
          <Nodes title={t('apply.added')} nodes={plan.added} />
          <Nodes title={t('apply.removed')} nodes={plan.removed} />
          <Nodes
            title={t('apply.latePorts')}
            nodes={plan.late_ports.map((each) => ({ ...each, path: `${each.path}: ${each.port}` }))}
          />
          <Group justify="flex-end" gap="xs">
            <Button variant="default" onClick={refuse}>
              {t('apply.cancel')}
            </Button>
            <Button onClick={() => answer(true)} data-autofocus data-testid="apply-anyway">
              {t(name === 'apply' ? 'command.apply' : 'apply.runOn')}
            </Button>
          </Group>
        </Stack>
      ) : null}
    </Modal>
  );
}

const MOST_SHOWN = 8;
/** The engine adds a number to unnamed blocks: `Forward::6`. */
const NUMBER = /::\d+(?=[/:]|$)/g;

/** A list of blocks by path; of a long list the first, and the number of the others. */
function Nodes({ title, nodes }: { readonly title: string; readonly nodes: readonly AppliedNode[] }) {
  const { t } = useTranslation('run');
  if (nodes.length === 0) return null;
  const rest = nodes.length - MOST_SHOWN;
  return (
    <div>
      <Text size="sm" fw={600}>
        {title}
      </Text>
      <List size="sm">
        {nodes.slice(0, MOST_SHOWN).map(({ path, tree_id, node_id }) => (
          <List.Item key={`${path} ${tree_id} ${node_id}`}>{path.replace(NUMBER, '')}</List.Item>
        ))}
        {rest > 0 ? <List.Item>{t('apply.more', { count: rest })}</List.Item> : null}
      </List>
    </div>
  );
}
