/** Everything that can happen to the state, for tests that make much of it happen. */
export * from '../../../web/ui/file-changes';
export * from '../../../web/ui/model-changes';
export * from '../../../web/ui/reaction-changes';
export * from '../../../web/ui/settings-changes';
export * from '../../../web/ui/store';
export * from '../../../web/ui/telling-changes';
export * from '../../../web/ui/view-changes';
